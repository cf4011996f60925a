// Self-similar: a cube bored through in squares, twice over.
module bores(size, depth) {
  third = size / 3;
  for (x = [0:pow(3, depth - 1) - 1], y = [0:pow(3, depth - 1) - 1]) {
    s = 9 / pow(3, depth - 1);
    translate([x * s + s / 3, y * s + s / 3, -1]) cube([s / 3, s / 3, 11]);
  }
}
difference() {
  cube(9);
  for (depth = [1, 2]) {
    bores(9, depth);
    translate([0, 9, 0]) rotate([90, 0, 0]) bores(9, depth);
    translate([0, 0, 9]) rotate([0, 90, 0]) bores(9, depth);
  }
}
