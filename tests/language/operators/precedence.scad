echo(1 + 2 * 3, (1 + 2) * 3, 10 - 4 - 3, 2 * 3 % 4);
echo(true || false && false, !true || true, 1 < 2 == true);
echo(1 > 0 ? "yes" : "no", false ? 1 : true ? 2 : 3);
echo(-[1, 2], - -3, +4, !!5);

// expect: ECHO: 7, 9, 3, 2
// expect: ECHO: true, true, true
// expect: ECHO: "yes", 2
// expect: ECHO: [-1, -2], 3, 4, true
