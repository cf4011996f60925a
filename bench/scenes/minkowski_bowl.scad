// minkowski() of two solids that are both not convex: balls with a ball's bite
// and a pierced cube
fn = 16;
minkowski() {
  difference() {
    sphere(10, $fn = fn);
    translate([0, 0, 5]) sphere(8, $fn = fn);
  }
  difference() {
    cube(4, center = true);
    cylinder(r = 1, h = 10, center = true, $fn = fn / 2);
  }
}
