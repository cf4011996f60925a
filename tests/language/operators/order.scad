// Operators evaluate their right operand first, except for && and ||.
function f(x) = echo(x) x;
sum = f(1) + f(2);
product = f(3) * f(4) ^ f(5);
less = f(6) < f(7);
equal = f(8) == f(9);
both = f(10) && f(11);
either = f(0) || f(12);
range = [f(13):f(14):f(15)];
element = [f(16), f(17)][f(0)];
// expect: ECHO: 2
// expect: ECHO: 1
// expect: ECHO: 5
// expect: ECHO: 4
// expect: ECHO: 3
// expect: ECHO: 7
// expect: ECHO: 6
// expect: ECHO: 9
// expect: ECHO: 8
// expect: ECHO: 10
// expect: ECHO: 11
// expect: ECHO: 0
// expect: ECHO: 12
// expect: ECHO: 13
// expect: ECHO: 15
// expect: ECHO: 14
// expect: ECHO: 0
// expect: ECHO: 16
// expect: ECHO: 17
