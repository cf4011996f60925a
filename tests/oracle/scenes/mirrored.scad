// Mirror images about axes and a slanted plane, of Booleans too.
module part() {
  difference() {
    cube([5, 3, 4]);
    translate([1, 1, -1]) cylinder(r = 0.6, h = 6, $fn = 12);
    translate([4, 2, 3]) rotate([0, 30, 0]) cube([3, 3, 3]);
  }
}
part();
mirror([1, 0, 0]) translate([2, 0, 0]) part();
mirror([0, 1, 0]) translate([0, 2, 0]) part();
mirror([1, 1, 0]) translate([4, -9, 0]) part();
mirror([1, 2, 3]) translate([12, 0, 0]) part();
