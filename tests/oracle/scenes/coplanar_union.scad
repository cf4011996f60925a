// Faces that touch whole or in part unite without an inner wall.
cube([2, 2, 4]);
translate([2, 0, 0]) cube([2, 2, 4]);
translate([4, 0.5, 0]) cube([2, 1, 3]);
translate([2, 2, 1]) cube([1, 3, 2]);
translate([0, 2, 0]) cube([2, 1, 4]);
intersection() {
  translate([8, 0, 0]) cube([4, 4, 4]);
  translate([8, 0, 0]) cube([4, 2, 4]);
}
