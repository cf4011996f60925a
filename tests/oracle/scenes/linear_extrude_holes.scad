// A polygon with two holes by paths, and a star.
linear_extrude(height = 4)
  polygon(points = [[0, 0], [10, 0], [11, 7], [0, 8],
                    [2, 2], [4, 2], [3, 5], [6, 2], [8, 3], [7, 6]],
          paths = [[0, 1, 2, 3], [4, 5, 6], [7, 8, 9]]);
translate([18, 4, 2])
  linear_extrude(height = 4, center = true)
    polygon([for (i = [0:9]) (i % 2 == 0 ? 4 : 1.7) *
                             [cos(36 * i), sin(36 * i)]]);
