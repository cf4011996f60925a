a = 1;
translate([a, 0, 0]) {
  a = 2;
  echo(a);
  union() {
    echo(a);
    a = 3;
  }
}
echo(a);
if (true) {
  a = 5;
  echo(a);
}
echo(a);

// expect: ECHO: 2
// expect: ECHO: 3
// expect: ECHO: 1
// expect: ECHO: 5
// expect: ECHO: 1
// expect csg: multmatrix([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tunion();
// expect csg: }
// expect csg: group();
