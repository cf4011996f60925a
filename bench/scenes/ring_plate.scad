// ring_plate: N x N standing rings of ring55, as a caster fills a printer's plate.
//   55 N^2 leaves; N=8 with k=165 has 3,520, 68 million triangles.
include <ring55.scad>  // draws the first ring
N = 2;
upright = 1;
for (i = [0 : N - 1], j = [0 : N - 1]) if (i + j > 0)
  translate([24*i, 10*j, 0]) rotate([90, 0, 0]) ring55();
