// Twisted columns, one with a hole, one that also shrinks.
linear_extrude(height = 8, twist = 75, slices = 12) square(4, center = true);
translate([9, 0, 0]) linear_extrude(height = 8, twist = -120, $fn = 30)
  polygon(points = [[-3, -3], [3, -3], [3, 3], [-3, 3],
                    [-1, -1], [1, -1], [1, 1], [-1, 1]],
          paths = [[0, 1, 2, 3], [4, 5, 6, 7]]);
translate([0, 9, 0]) linear_extrude(height = 8, twist = 90, scale = 0.5,
                                    slices = 10)
  translate([1, 0]) circle(r = 2, $fn = 9);
