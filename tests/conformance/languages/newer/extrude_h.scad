// 2026: 3.0 mm³
linear_extrude(h = 3) square(1);
