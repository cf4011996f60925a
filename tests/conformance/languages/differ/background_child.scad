// 2026: 1000 mm³
module first() children(0);
first() { cube(10); cube(20); }
module background() { %children(0); cube(10); }
background() cube(20);
