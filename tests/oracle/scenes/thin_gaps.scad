// Gaps of 0.01 mm along x, along y and turned.
g = 0.01;
module gaps() {
  difference() {
    cube([6, 6, 2]);
    for (i = [1:5]) translate([i - g / 2, 0.5, -1]) cube([g, 5, 4]);
  }
}
gaps();
translate([8, 6, 0]) rotate(-90) gaps();
translate([20, 0, 0]) rotate(37) gaps();
