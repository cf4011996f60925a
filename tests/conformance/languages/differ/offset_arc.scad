// The steps of an arc: to the nearest number or up.
linear_extrude(height = 1) {
  offset(r = 1) square(10);
  translate([20, 0]) offset(r = 3, $fn = 7) polygon([[0, 0], [5, 0], [0, 9]]);
  translate([40, 0]) offset(r = -1) difference() { square(10); translate([3, 3]) square(4); }
}
