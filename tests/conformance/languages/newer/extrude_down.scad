// A vector that points down makes nothing.
linear_extrude(v = [1, 0, -2]) square(2);
cube(1);
