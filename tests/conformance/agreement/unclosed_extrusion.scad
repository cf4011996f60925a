// openscad's mesh is no judge
// Outlines that touch in a point: openscad finds its own extrusion of them not
// closed, and leaves it out.
cube([20, 20, 0.5]);
translate([0, 0, 0.3]) linear_extrude(0.3) {
  polygon([[0, 0], [10, -2], [10, -1]]);
  polygon([[0, 0], [10, 2], [10, 1]]);
}
