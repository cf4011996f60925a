// Coincident faces whose coordinates are rounded.
rotate([10, 20, 37]) {
  cube([3, 3, 6]);
  translate([3, 0, 0]) cube([2, 3, 6]);
  translate([0, 3, 0]) cube([5, 1, 4]);
  translate([8, 0, 0]) difference() {
    cube([5, 5, 6]);
    translate([0, 1, 0]) cube([2, 2, 6]);
    translate([3, 0, 0]) cube([2, 2, 6]);
  }
}
