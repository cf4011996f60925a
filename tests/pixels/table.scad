// A table on one leg: a ledge all round that supports must hold.
translate([-1, -1, 0]) cube([2, 2, 4]);
translate([-5, -5, 4]) cube([10, 10, 0.8]);
