// A height of -0 is 0; a scale of -0 stays.
linear_extrude(height = -0, scale = -0) square(1);

// expect csg: linear_extrude(height = 0, center = false, convexity = 1, scale = [-0, -0], $fn = 0, $fa = 12, $fs = 2) {
// expect csg: \tsquare(size = [1, 1], center = false);
// expect csg: }
