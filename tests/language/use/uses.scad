use <library_part.scad>
offset = 99;
echo(shifted(1));
show();
show(offset);
wrong();
$fn = 8;
echo(facets());
echo(hidden);
function shifted(x) = -x;
use <missing_file.scad>

// expect: WARNING: Can't open library 'missing_file.scad'.
// expect: ECHO: -1
// expect: ECHO: 10, 1
// expect: ECHO: 99, 1
// expect: WARNING: undefined operation (number + string) in file library_part.scad, line 7
// expect: ECHO: undef
// expect: WARNING: Ignoring unknown module 'nowhere' in file library_part.scad, line 7
// expect: WARNING: variable sice not specified as parameter in file library_part.scad, line 7
// expect: ECHO: 8
// expect: WARNING: Ignoring unknown variable 'hidden' in file uses.scad, line 9
// expect: ECHO: undef
// expect csg: group();
// expect csg: group();
// expect csg: group() {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
