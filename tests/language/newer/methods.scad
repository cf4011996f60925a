// A function with a parameter `this` gets the object that it was taken from.
o = object(n = 3, sum = function(a, this) a + this.n, plain = function() this, other = function(a) a);
echo(o.sum(4), o["sum"](5), o.sum(a = 1), o.other(6));
echo(o.plain());
f = o.sum;
echo(f(10), object(n = 9, sum = f).sum(1), object(o, n = 100).sum(1), o.sum(1));
echo(f == o.sum, o.sum == object(o).sum, o == object(o), object(f = o.other).f == o.other);
echo(o.sum);

// Whatever a caller gives for it.
echo(o.sum(1, object(n = 50)), o.sum(1, this = 5), object(f = function(this) this.x, x = 1).f(2));
// Called as a plain function it is a parameter like any other.
g = function(this) this;
echo(g(), g(1), object(f = function(h, this) h()).f(g));

// Recursion, by the object and by a name.
echo(object(f = function(n, this) n > 1 ? n * this.f(n - 1) : 1).f(5));
count = object(step = 2, to = function(n, this) n <= 0 ? 0 : this.step + this.to(n - 1)).to;
echo(count(1000));
loop = function(n, this) n == 0 ? this.v : loop(n - 1, 7);
bound = object(v = "v", loop = loop);
echo(bound.loop(0));

// Closures take it along.
adder = object(n = 5, make = function(this) function(a) a + this.n).make();
echo(adder(1));
echo([for (m = [o.sum, object(n = 1, s = o.sum).s]) m(0)]);

// expect: ECHO: 7, 8, 4, 6
// expect: WARNING: Ignoring unknown variable 'this' in file methods.scad, line 2
// expect: ECHO: undef
// expect: ECHO: 13, 10, 101, 4
// expect: ECHO: true, false, false, true
// expect: ECHO: function(a, this) (a + this.n)
// expect: ECHO: 4, 4, 1
// expect: ECHO: undef, 1, undef
// expect: ECHO: 120
// expect: ECHO: 2000
// expect: ECHO: "v"
// expect: ECHO: 6
// expect: ECHO: [3, 1]
