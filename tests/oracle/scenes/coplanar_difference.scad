// Every face of the cutters lies in a face of the block: no skin is left.
difference() {
  cube([10, 10, 4]);
  translate([0, 2, 0]) cube([3, 2, 4]);
  translate([7, 0, 0]) cube([3, 3, 2]);
  translate([4, 4, 0]) cube([2, 2, 4]);
  translate([4, 4, 2]) cube([2, 6, 2]);
}
translate([12, 0, 0]) difference() {
  cube([4, 4, 4]);
  cube([4, 4, 2]);
}
