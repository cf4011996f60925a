// A ball: it begins in one point and reaches out ever less.
sphere(r = 3, $fn = 60);
