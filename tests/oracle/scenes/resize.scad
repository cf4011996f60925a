// What is left of a Boolean fits the new size.
resize([12, 0, 0], auto = true) difference() {
  sphere(5, $fn = 24);
  translate([3, 0, 0]) cube(12, center = true);
}
translate([0, 20, 0]) resize([7, 9, 0]) intersection() {
  sphere(5, $fn = 24);
  translate([4, 2, 1]) sphere(5, $fn = 20);
}
translate([0, 40, 0]) linear_extrude(height = 3)
  resize([10, 0], auto = true) difference() {
    circle(3, $fn = 20);
    translate([2, 0]) square(4);
  }
