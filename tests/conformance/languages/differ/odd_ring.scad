// Where a whole ring starts.
rotate_extrude($fn = 7) translate([2, 0]) square(1);
