// Operators five deep.
difference() {
  union() {
    cylinder(r = 8, h = 6, $fn = 48);
    intersection() {
      translate([0, 0, 6]) sphere(r = 6, $fn = 32);
      difference() {
        translate([-6, -6, 5]) cube([12, 12, 6]);
        translate([-1, -7, 4]) cube([2, 14, 9]);
      }
    }
  }
  difference() {
    translate([0, 0, 1]) cylinder(r = 6, h = 4, $fn = 40);
    union() {
      for (a = [0:120:240]) rotate(a) translate([3, 0, 0])
        difference() {
          cylinder(r = 1.5, h = 7, $fn = 16);
          translate([0, 0, -1]) cylinder(r = 0.7, h = 9, $fn = 12);
        }
    }
  }
}
