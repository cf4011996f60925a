// A thousand leaves: a plate bored 500 times, with 499 rods through it.
difference() {
  cube([51, 41, 3]);
  for (i = [0:24], j = [0:19])
    translate([1 + 2 * i + 0.013 * j, 1 + 2 * j, -1])
      rotate(i * 3 + j * 5) cube([0.9, 0.8, 5]);
}
for (i = [0:498])
  translate([1.2 + 2 * (i % 25) + 0.013 * floor(i / 25),
             1.2 + 2 * floor(i / 25), -0.5 - 0.003 * i])
    cube([0.25, 0.2, 4 + 0.002 * i]);
