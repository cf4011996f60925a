// The right operand is evaluated before the left one, and an index before what
// it picks from.
function say(x) = echo(x) x;
x = say(1) + say(2) * say(3);
y = say(4) < say(5);
z = [say(6), say(7)][say(0)];
c = say(false) && say(8);

// expect: ECHO: 3
// expect: ECHO: 2
// expect: ECHO: 1
// expect: ECHO: 5
// expect: ECHO: 4
// expect: ECHO: 0
// expect: ECHO: 6
// expect: ECHO: 7
// expect: ECHO: false
