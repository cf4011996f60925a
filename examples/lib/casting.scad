// casting.scad: sprues and trees for casting, for OpenSCAD and lamina.
//
//   use <lib/casting.scad>
//
// `lamina sprue` and `lamina tree` find where sprues and pieces go and write such
// lines themselves; these are for designs that say it. All lengths are
// millimetres, all angles degrees.

// A sprue from `end`, inside the piece, to `root`, where it joins a tree. It is
// d wide in the piece and wider at the root, so that metal there freezes last.
module sprue(end, root, d = 2.5, root_d = 0) {
  hull() {
    translate(end) sphere(d = d, $fn = 24);
    translate(root) sphere(d = root_d > 0 ? root_d : 1.3 * d, $fn = 32);
  }
}

// A plate on which a piece stands that has nothing but its sprue below it. Its
// top is at the origin.
module disc(d = 10, thickness = 1.5) {
  translate([0, 0, -thickness]) cylinder(d = d, h = thickness, $fn = 64);
}

// A trunk with `count` times the children, `around` of them in each level. The
// child's root is at the origin and the piece above it; here it leans outwards
// and points up by `tilt`.
module tree(count, around = 6, step = 15, first = 20, tilt = 45, trunk = 8) {
  assert(count >= 1, "tree: count must be at least 1");
  levels = ceil(count / around);
  height = first + (levels - 1) * step;
  cylinder(d = trunk, h = height, $fn = 48);
  translate([0, 0, height]) sphere(d = trunk, $fn = 48);
  cylinder(d1 = 2 * trunk, d2 = trunk, h = 5, $fn = 48);
  for (i = [0 : count - 1])
    let (level = floor(i / around))
      rotate([0, 0, 360 * (i + level / 2) / around])
        translate([trunk / 4, 0, first + level * step])
          rotate([0, 90 - tilt, 0]) children();
}
