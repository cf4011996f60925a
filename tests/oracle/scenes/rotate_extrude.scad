// A torus, a hollow torus, and a goblet that touches its axis.
rotate_extrude($fn = 40) translate([5, 0]) circle(r = 1.5, $fn = 20);
translate([16, 0, 0]) rotate_extrude($fn = 36)
  polygon(points = [[4, -1.5], [7, -1.5], [7, 1.5], [4, 1.5],
                    [5, -0.5], [6, -0.5], [6, 0.5], [5, 0.5]],
          paths = [[0, 1, 2, 3], [4, 5, 6, 7]]);
translate([8, 12, -1.5]) rotate_extrude($fn = 30)
  polygon([[0, 0], [3, 0], [0.5, 0.7], [0.6, 1.5], [3, 3], [2.7, 3], [0, 1.6]]);
