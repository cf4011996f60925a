// What a program takes to start.
cube(1);
