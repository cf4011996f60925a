linear_extrude(v = [2, 0, 6], twist = 90, slices = 6, segments = 0)
  square([3, 1]);
