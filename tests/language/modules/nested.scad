module outer(a) {
  b = a * 2;
  function f(x) = x + b;
  module inner(c = f(1)) { echo(a, b, c); }
  inner();
  inner(0);
  for (i = [0 : 1]) inner(f(i));
}
outer(1);
outer(5);
inner();

// expect: ECHO: 1, 2, 3
// expect: ECHO: 1, 2, 0
// expect: ECHO: 1, 2, 2
// expect: ECHO: 1, 2, 3
// expect: ECHO: 5, 10, 11
// expect: ECHO: 5, 10, 0
// expect: ECHO: 5, 10, 10
// expect: ECHO: 5, 10, 11
// expect: WARNING: Ignoring unknown module 'inner' in file nested.scad, line 11
// expect csg: group() {
// expect csg: \tgroup();
// expect csg: \tgroup();
// expect csg: \tgroup() {
// expect csg: \t\tgroup();
// expect csg: \t\tgroup();
// expect csg: \t}
// expect csg: }
// expect csg: group() {
// expect csg: \tgroup();
// expect csg: \tgroup();
// expect csg: \tgroup() {
// expect csg: \t\tgroup();
// expect csg: \t\tgroup();
// expect csg: \t}
// expect csg: }
