// multmatrix: shears along each axis, a shear with a mirror image.
multmatrix([[1, 0.4, 0.7, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
  cylinder(r = 2, h = 5, $fn = 32);
multmatrix([[1, 0, 0, 10], [0, 1, 0, 0], [0.5, -0.3, 1, 0], [0, 0, 0, 1]])
  difference() {
    cube([4, 4, 4]);
    translate([2, 2, -1]) cylinder(r = 1, h = 6, $fn = 20);
  }
multmatrix([[-1, 0.3, 0, 0], [0.2, 1, 0.4, 10], [0, 0.5, 1.2, 0], [0, 0, 0, 1]])
  sphere(r = 3, $fn = 20);
