// 2026: 3.750 mm³
// A ring's part rounds its number of steps up.
rotate_extrude(angle = 90) translate([2, 0]) square(1);
