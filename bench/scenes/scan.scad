// scan: a closed mesh from a file, about 20 mm wide and around the origin,
// alone or with Booleans: pierced by 49 drills and cut off below.
file = "bunny.stl";
pierced = false;
if (pierced) {
  difference() {
    import(file);
    for (x = [-3 : 3], z = [-3 : 3]) translate([2.5*x, 0, 2.5*z])
      rotate([90, 0, 0]) cylinder(r = 0.4, h = 40, center = true, $fn = 32);
    translate([-20, -20, -26]) cube([40, 40, 20]);
  }
} else {
  import(file);
}
