echo(nothing);
nothing();
x = nothing(1);
shpere(r = 3);
cube(nothing);

// expect: WARNING: Ignoring unknown function 'nothing' in file unknown_names.scad, line 3
// expect: WARNING: Ignoring unknown variable 'nothing' in file unknown_names.scad, line 1
// expect: ECHO: undef
// expect: WARNING: Ignoring unknown module 'nothing' in file unknown_names.scad, line 2
// expect: WARNING: Ignoring unknown module 'shpere' in file unknown_names.scad, line 4
// expect: WARNING: Ignoring unknown variable 'nothing' in file unknown_names.scad, line 5
// expect csg: cube(size = [1, 1, 1], center = false);
