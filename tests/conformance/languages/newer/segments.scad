// 2026: 15.72 mm³
linear_extrude(height = 4, twist = 90, slices = 4, segments = 64)
  square(2, center = true);
