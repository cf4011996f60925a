// Parts of a turn, forth and back, one with a hole in its profile.
rotate_extrude(angle = 100, $fn = 48) translate([4, 0]) square([2, 3]);
translate([10, 0, 0]) rotate_extrude(angle = -200, $fn = 30)
  translate([4, 1.5]) circle(r = 1.5, $fn = 12);
translate([0, -12, 0]) rotate_extrude(angle = 270, $fn = 40)
  polygon(points = [[2, 0], [6, 0], [6, 3], [2, 3],
                    [3, 1], [5, 1], [5, 2], [3, 2]],
          paths = [[0, 1, 2, 3], [4, 5, 6, 7]]);
