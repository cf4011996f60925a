rotate_extrude(angle = 45, $fn = 30) translate([-3, 0]) square([1, 2]);
