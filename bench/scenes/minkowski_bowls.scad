// minkowski() of two bitten balls, neither of them convex, of as many facets
fn = 16;
minkowski() {
  difference() {
    sphere(10, $fn = fn);
    translate([0, 0, 5]) sphere(8, $fn = fn);
  }
  difference() {
    sphere(4, $fn = fn);
    translate([0, 0, -2]) sphere(3, $fn = fn);
  }
}
