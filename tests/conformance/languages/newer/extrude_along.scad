// 2026: 2.0 mm³
linear_extrude(v = [1, 0, 2]) square(1);
