module a() { echo(parent_module(0), $parent_modules); b(); }
module b() { echo(parent_module(1), parent_module(), $parent_modules); children(); }
a();
b() a();
echo(parent_module(0));

// expect: ECHO: "a", 1
// expect: ECHO: "a", "a", 2
// expect: WARNING: Parent module index (1) greater than the number of modules on the stack in file parent_module.scad, line 2
// expect: WARNING: Parent module index (1) greater than the number of modules on the stack in file parent_module.scad, line 2
// expect: ECHO: undef, undef, 1
// expect: ECHO: "a", 2
// expect: ECHO: "a", "a", 3
// expect: WARNING: Parent module index (0) greater than the number of modules on the stack in file parent_module.scad, line 5
// expect: ECHO: undef
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tgroup();
// expect csg: \t}
// expect csg: }
// expect csg: group() {
// expect csg: \tgroup() {
// expect csg: \t\tgroup() {
// expect csg: \t\t\tgroup() {
// expect csg: \t\t\t\tgroup();
// expect csg: \t\t\t}
// expect csg: \t\t}
// expect csg: \t}
// expect csg: }
