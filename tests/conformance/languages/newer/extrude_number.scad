// 2026: 10 mm³
linear_extrude(2.5) square(2);
