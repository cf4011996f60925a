// A chequered block: cubes that touch along edges only, and such holes.
for (x = [0:3], y = [0:3])
  if ((x + y) % 2 == 0) translate([x, y, 0]) cube([1, 1, 2]);
translate([6, 0, 0]) difference() {
  cube([6, 6, 2]);
  for (x = [1:4], y = [1:4])
    if ((x + y) % 2 == 0) translate([x, y, -1]) cube([1, 1, 4]);
}
