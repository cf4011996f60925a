// A name that stands twice among the parameters is one variable: the last
// argument counts, or the last fallback.
module m(r, a, r = 5) echo(r, a);
m();
m(1);
m(1, 2);
m(1, 2, 3);
m(r = 4, a = 6);

function f(r = 1, r = 2) = r;
g = function(r, b = 7, r) [r, b];
echo(f(), f(3), f(3, 4), f(r = 5), g(), g(1), g(1, 2, 3));

// The parameters unused in one place must not stay unset in another.
module inner(d, r, h, r) echo(d = d, r = r, h = h);
module outer(d) inner(d = d, h = 2);
outer(8);

// expect: ECHO: 5, undef
// expect: ECHO: 1, undef
// expect: ECHO: 1, 2
// expect: ECHO: 3, 2
// expect: ECHO: 4, 6
// expect: ECHO: 2, 3, 4, 5, [undef, 7], [1, 7], [3, 2]
// expect: ECHO: d = 8, r = undef, h = 2
