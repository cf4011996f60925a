// agree on a finer grid
// openscad rounds the outline to its grid before it is enlarged, here to steps
// of 0.0015 mm.
linear_extrude(3) scale(100) {
  difference() {
    circle(0.5, $fn = 77);
    rotate(7) translate([0.1, 0]) circle(0.3, $fn = 55);
  }
}
