function count(n, acc = 0) = n == 0 ? acc : count(n - 1, acc + 1);
echo(count(100000));
function even(n) = n == 0 ? true : odd(n - 1);
function odd(n) = n == 0 ? false : even(n - 1);
echo(even(1000));
function f(n, base = start) = n == 0 ? base : f(n - 1);
start = 42;
echo(f(3));

// expect: ECHO: 100000
// expect: ECHO: true
// expect: ECHO: 42
