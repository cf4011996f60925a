// Slices of a twist that also scales.
linear_extrude(height = 10, twist = 200, scale = [2, 0.5], $fn = 20)
  translate([3, 1]) square([4, 2]);
