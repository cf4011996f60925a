// Whether an argument sees another one's variable.
$x = 1;
module m(a) { echo(a, $x); }
function f(a) = [a, $x];
m($x = 2, a = $x);
echo(f($x = 3, a = $x));
