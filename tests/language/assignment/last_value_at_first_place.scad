a = 1;
b = a;
a = 2;
echo(a, b);
module m() {
  x = y;
  y = 3;
  echo(x, y);
}
y = 4;
m();

// expect: WARNING: a was assigned on line 1 but was overwritten in file last_value_at_first_place.scad, line 3
// expect: ECHO: 2, 2
// expect: ECHO: 4, 3
// expect csg: group();
