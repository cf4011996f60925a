module m(b, a) { echo(a, b); }
m(a = echo("first") 1, b = echo("second") 2);
