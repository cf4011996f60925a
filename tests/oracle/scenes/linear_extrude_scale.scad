// Extrusions that shrink, grow in one direction, and end in a point.
linear_extrude(height = 6, scale = 0.4) square([4, 3], center = true);
translate([8, 0, 0]) linear_extrude(height = 6, scale = [2, 0.5])
  square([3, 4], center = true);
translate([0, 8, 0]) linear_extrude(height = 6, scale = 0)
  circle(r = 3, $fn = 20);
