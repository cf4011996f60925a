// Walls of 0.01 mm along x, along y and turned, and slanted ones.
g = 0.01;
module walls() {
  cube([6, 6, 0.3]);
  for (i = [1:5]) translate([i - g / 2, 0.5, 0]) cube([g, 5, 2]);
}
walls();
translate([8, 6, 0]) rotate(-90) walls();
translate([20, 0, 0]) rotate(37) walls();
translate([0, 8, 0]) multmatrix([[1, 0, 0.5, 0], [0, 1, 0, 0], [0, 0, 1, 0],
                                 [0, 0, 0, 1]]) walls();
