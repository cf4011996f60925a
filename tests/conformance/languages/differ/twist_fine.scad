// $fa and $fs rule the slices of a twist.
linear_extrude(height = 12, twist = -75, $fa = 3, $fs = 0.5) square([6, 1]);
