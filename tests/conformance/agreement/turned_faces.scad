// openscad's mesh is no judge
// It leaves a polyhedron out one face of which looks inwards; lamina turns it.
cube([4, 4, 1]);
translate([0, 0, 0.9]) polyhedron([[1, 1, 0], [3, 1, 0], [2, 3, 0], [2, 2, 3]],
  [[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 3, 2]]);
