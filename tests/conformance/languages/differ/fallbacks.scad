// Defaults that nobody needs.
module m(a = echo("a") 1, b = echo("b") 2) { echo(a, b); }
function f(x = echo("x") 3) = x;
m(5);
m(b = 6);
echo(f(7), f());
