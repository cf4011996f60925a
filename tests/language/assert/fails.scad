function check(x) = assert(x != 3, str("not ", x)) x;
module m(x) { cube(check(x)); }
m(2);
m(3);
echo("never");

// expect: ERROR: Assertion '(x != 3)' failed: "not 3" in file fails.scad, line 1
// expect: TRACE: called by 'check' in file fails.scad, line 2
// expect: TRACE: called by 'cube' in file fails.scad, line 2
// expect: TRACE: called by 'm' in file fails.scad, line 4
