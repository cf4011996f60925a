// A tetrahedron with a slanted base and a concave arrowhead prism.
polyhedron(points = [[0, 0, 0], [4, 0, 1], [0, 4, 0.5], [1, 1, 5]],
           faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]);
translate([6, 0, 0])
  polyhedron(points = [[0, 0, 0], [4, 2, 0], [0, 4, 0], [1.5, 2, 0],
                       [0, 0, 4], [4, 2, 4], [0, 4, 4], [1.5, 2, 4]],
             faces = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1],
                      [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]]);
