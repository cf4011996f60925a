// One or two of each kind of finding, large and small, for the tests of `check`.

module hollow(size) {
  difference() {
    cube(size);
    translate([0.6, 0.6, 0.6]) cube(size - 1.2);
  }
}

// A resin trap, and a smaller one with walls thinner than two pixels.
hollow(4);
translate([6, 0, 0]) difference() {
  cube(1.2);
  translate([0.06, 0.06, 0.06]) cube(1.08);
}

// A cup on the plate, and one that the film closes until its window opens.
translate([0, 6, 0]) difference() {
  cylinder(d = 5, h = 3, $fn = 40);
  translate([0, 0, -1]) cylinder(d = 3.4, h = 3, $fn = 40);
}
translate([7, 6, 0]) difference() {
  cylinder(d = 4, h = 4, $fn = 40);
  translate([0, 0, 1]) cylinder(d = 3, h = 4, $fn = 40);
  translate([0, -0.5, 2]) cube([5, 1, 1]);
}

// A loose part, and one of a few pixels.
translate([12, 0, 1.513]) rotate([20, 30, 0]) cube([2, 1, 1]);
translate([12, 3, 1.513]) cube(0.12);

// Hooks: islands until the bar above joins them. Their tips are blunt, or a
// pixel wide, or a blade that no pixel shows.
translate([12, 6, 0]) {
  cube([1, 4, 4]);
  for (i = [0 : 2])
    translate([0.5, 1.5 * i, 3.5]) {
      width = [0.8, 0.035, 0.01][i];
      cube([3, 0.9, 0.5]);
      translate([2, 0, -1.7]) cube([0.9, width, 2]);
    }
}

// A needle hangs from the bar: its lowest layers are smaller than a pixel.
translate([13.3, 11.5, 0]) {
  translate([0, 0, 0.8]) cylinder(r1 = 0.001, r2 = 0.5, h = 2.7, $fn = 30);
  translate([-1, -0.5, 3.5]) cube([2, 1, 0.5]);
  translate([-1.3, -2, 0]) cube([1, 2.5, 4]);
}

// Two parts a tenth of a pixel apart: the upper one hangs in mid-air beside
// a pillar.
translate([12, 14, 0]) {
  cube([1, 1, 4]);
  translate([1.0035, 0, 1.5]) cube([2, 1, 2]);
  translate([0, 0, 4]) cube([3, 1, 1]);
}

// Arms of several lengths hang over; a slope of 44° does not.
translate([0, 12, 0]) {
  cube([2, 3, 3]);
  for (i = [0 : 2])
    translate([2, i, 2.2]) cube([[0.04, 0.3, 2][i], 0.8, 0.8]);
  translate([0, 3, 0]) rotate([90, 0, 90])
    linear_extrude(2) polygon([[-1, 0], [0, 0], [1.93, 2], [-1, 2]]);
}
