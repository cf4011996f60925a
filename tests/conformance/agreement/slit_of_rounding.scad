// agree but for rounding
// A slit of 3e-7 mm, such as sums of inches leave, parts openscad's solid.
cube([5, 4, 2]);
translate([-5.0000003, 1, 0]) cube([5, 2, 2]);
