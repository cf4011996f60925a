// agree but for rounding
// The arc around the narrow foot turns by 20.5 steps of 3.6 degrees; rounded
// coordinates decide in either program whether that makes 20 or 21.
$fn = 100;
r = 2.10526;
linear_extrude(3) offset(r) offset(-2 * r) offset(r) {
  translate([-32.1, -10.2]) square([6, 16.2]);
  translate([-32.1, -16.2]) square([9, 6]);
}
