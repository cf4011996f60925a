// Shadows and sections of Booleans, extruded.
module part() {
  difference() {
    union() {
      sphere(8, $fn = 24);
      translate([6, 0, 0]) cube([6, 5, 4]);
    }
    translate([0, 0, -10]) cylinder(h = 20, r = 3, $fn = 18);
    translate([4, 3, 1.3]) sphere(6, $fn = 20);
  }
}
linear_extrude(height = 2) projection() part();
translate([0, 30, 0]) linear_extrude(height = 2) projection(cut = true) part();
// Only touches the plane.
translate([30, 0, 0]) linear_extrude(height = 3) projection(cut = true) cube(5);
