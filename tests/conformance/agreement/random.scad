// draw random numbers
cube(rands(1, 2, 1)[0]);
