// Three solids at once, and an intersection of separate parts that is empty.
intersection() {
  sphere(r = 5, $fn = 40);
  cube([8, 8, 8], center = true);
  rotate([0, 20, 30]) cylinder(r = 4, h = 20, center = true, $fn = 30);
}
intersection() {
  cube(2);
  translate([20, 0, 0]) cube(2);
}
