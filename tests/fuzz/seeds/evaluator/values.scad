function fib(n) = n < 2 ? n : fib(n - 1) + fib(n - 2);
echo(fib(8), [for (i = [0:3]) each [i, i * i]], concat([1], [2, [3]]), str("a", 1, [true]));
echo(search("b", "abc"), lookup(1.5, [[1, 2], [2, 4]]), len("xy"), chr([65, 66]), ord("A"), cross([1, 2, 3], [4, 5, 6]));
echo(min(1, 2), max([3, 4]), norm([3, 4]), round(1.5), sqrt(2), atan2(1, 2), pow(2, 10), rands(0, 1, 3, 42), sin(30), abs(-1), sign(-2), exp(1), ln(2), log(100));
echo([1, 2] * [[1, 2], [3, 4]], [1, 2] + [3, 4], -[1], 7 % 3, 1 / 0, [1, 2, 3].z, "abc"[1], [1:3][2], version(), is_undef(x), is_list([]), is_function(function(x) x));
a = [for (i = 0, x = 1; i < 5; i = i + 1, x = x * 2) x]; echo(a, let(b = 2) b ^ 3, a == a, [1, 2] < [1, 3], parent_module());
assert(a[4] == 16, "powers"); echo(let(f = function(x) x + 1) f(2), 5 & 3, 1 << 4, ~0, 6 | 1);
