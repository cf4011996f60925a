// A vector that nobody else holds may be written in place; all others stay.
v = [1, 2, 3];
m = [v, [4, 5, 6], "x", undef];
function same(x) = x;
function twice(x) = [x, x];
echo(v * 2 + [1, 1, 1], v);
echo(same(v) * 2, same(v) / 2, -same(v), v);
echo([v, v] * 2, [v, v] + [v, v], -[v, v], v);
echo(twice(v) * 2 + twice(v), v);
echo(twice([1, 2]) * 2 - twice([1, 1]));
echo([1, 2, 3] + [1, 2], [1, 2] - [1, 2, 3], [1, 2, 3] * 2 + [1]);
echo(2 * m, m / 2, 6 / [1, [2, 3]], m);
echo(let (a = [1, 2]) [a * 2, -a, a + a, a], concat(v, [4]) * 2, v);
echo([for (x = [v, v]) x * 2 + x], v);
echo([[1, 2], [3, 4]][1] * 2, m[0] * 2, m);
w = concat(v, [4]);
u = concat(w, [5]);
echo(w * 2, u * 3, same(w) + u, w, u, v);
echo([] + [], [] * 2, -[], [] + [1]);
// expect: ECHO: [3, 5, 7], [1, 2, 3]
// expect: ECHO: [2, 4, 6], [0.5, 1, 1.5], [-1, -2, -3], [1, 2, 3]
// expect: ECHO: [[2, 4, 6], [2, 4, 6]], [[2, 4, 6], [2, 4, 6]], [[-1, -2, -3], [-1, -2, -3]], [1, 2, 3]
// expect: ECHO: [[3, 6, 9], [3, 6, 9]], [1, 2, 3]
// expect: ECHO: [[1, 3], [1, 3]]
// expect: ECHO: [2, 4], [0, 0], [3]
// expect: ECHO: [[2, 4, 6], [8, 10, 12], undef, undef], [[0.5, 1, 1.5], [2, 2.5, 3], undef, undef], [6, [3, 2]], [[1, 2, 3], [4, 5, 6], "x", undef]
// expect: ECHO: [[2, 4], [-1, -2], [2, 4], [1, 2]], [2, 4, 6, 8], [1, 2, 3]
// expect: ECHO: [[3, 6, 9], [3, 6, 9]], [1, 2, 3]
// expect: ECHO: [6, 8], [2, 4, 6], [[1, 2, 3], [4, 5, 6], "x", undef]
// expect: ECHO: [2, 4, 6, 8], [3, 6, 9, 12, 15], [2, 4, 6, 8], [1, 2, 3, 4], [1, 2, 3, 4, 5], [1, 2, 3]
// expect: ECHO: [], [], [], []
