// In 2021.01 leaves have their surfaces, and what is taken away takes its own
// along; newer OpenSCAD shows what is just above the plane.
module c(x) { translate([x, 0, 0]) projection(cut = true) children(); }
linear_extrude(1) {
  c(0) difference() { translate([0, 0, -1]) cube([4, 4, 2]); translate([1, 1, 0]) cube([2, 2, 5]); }
  c(5) difference() { translate([0, 0, -1]) cube([4, 4, 2]); translate([1, 1, -5]) cube([2, 2, 5]); }
  c(10) union() { translate([0, 0, -2]) cube([4, 4, 2]); translate([1, 1, 0]) cube([2, 2, 2]); }
  c(15) union() { cube([4, 4, 2]); translate([5, 0, -2]) cube([4, 4, 2]); }
  c(25) difference() { cube([4, 4, 2]); translate([1, 1, 0]) cube([2, 2, 1]); }
  c(30) difference() { cube([4, 4, 2]); translate([1, 1, -1]) cube([2, 2, 5]); }
}
