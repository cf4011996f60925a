// Spheres of many, few and default facets.
sphere(r = 5, $fn = 48);
translate([9, 0, 0]) sphere(d = 5);
translate([0, 9, 1]) sphere(2, $fn = 5);
