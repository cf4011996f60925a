// Arguments without a name behind ones with a name.
module m(a = 0, b = 0, c = 0) { echo(a, b, c); }
function f(a = 0, b = 0, c = 0) = [a, b, c];
m(a = 1, 2, 3);
m(b = 1, 2, 3);
m(2, b = 1, 3);
echo(f(a = 1, 2), f(c = 1, 2, 3), f(2, a = 1, 3));
translate(v = [1, 0, 0]) cube(center = true, [1, 2, 3]);
