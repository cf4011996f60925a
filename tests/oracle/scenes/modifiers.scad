// What * and % leave out is not there; # changes nothing.
cube([4, 4, 2]);
*translate([0, 0, 1]) cube([9, 9, 2]);
%translate([6, 0, 0]) sphere(r = 3);
#translate([6, 6, 0]) cylinder(r = 2, h = 3, $fn = 20);
difference() {
  translate([12, 0, 0]) cube([4, 4, 3]);
  *translate([13, 1, -1]) cube([1, 1, 9]);
  #translate([14, 2, -1]) cube([1, 1, 9]);
}
