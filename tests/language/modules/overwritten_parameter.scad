module m(a = 1) {
  a = 2;
  echo(a);
}
m(3);

// expect: WARNING: Module m: Parameter a is overwritten with a literal in file overwritten_parameter.scad, line 2
// expect: ECHO: 2
// expect csg: group();
