echo(min(undef, echo("min") 1), max(1, "a", echo("max") 1));
echo(lookup(undef, echo("lookup") [[1, 2]]));
echo(rands(undef, echo("rands") 1, echo("third") 2));
echo(log("a", echo("log") 3), pow("a", echo("pow") 2));
