// 2026: 25.5 mm³
// The second argument without a name: r or r1.
cylinder(h = 4, 2);
