echo(rands(0, 10, 3, 42));
echo(rands(0, 1, 2, 1.5), rands(5, 5, 2, 1));
echo(len(rands(-1, 1, 100)));
echo(rands(0, 1));

// expect: ECHO: [7.96543, 1.83435, 7.79691]
// expect: ECHO: [0.7768, 0.0249309], [5, 5]
// expect: ECHO: 100
// expect: WARNING: rands() number of parameters does not match in file rands.scad, line 4
// expect: ECHO: undef
