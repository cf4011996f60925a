// A pyramid by scaling.
linear_extrude(height = 5, scale = 0) square([2, 4], center = true);
