cube("a");
cube([1, 2]);
cube(1, true, 2);
cube(size = 1, size = 2);
cube(sice = 2);
sphere(r = 1, d = 4);
cylinder(r = 1, r1 = 2);
translate("a") cube(1);
rotate("a") cube(1);
rotate([0, 0, 90], [1, 0, 0]) cube(1);
scale("a") cube(1);
mirror(1) cube(1);
color("nocolor") cube(1);
color([2, 0, 0]) cube(1);
cube(1) sphere(1);
square([1]);

// expect: WARNING: Unable to convert cube(size="a", ...) parameter to a number or a vec3 of numbers in file wrong_parameters.scad, line 1
// expect: WARNING: Unable to convert cube(size=[1, 2], ...) parameter to a number or a vec3 of numbers in file wrong_parameters.scad, line 2
// expect: WARNING: Too many unnamed arguments supplied in file wrong_parameters.scad, line 3
// expect: WARNING: argument size supplied more than once in file wrong_parameters.scad, line 4
// expect: WARNING: variable sice not specified as parameter in file wrong_parameters.scad, line 5
// expect: WARNING: Ignoring radius variable 'r' as diameter 'd' is defined too. in file wrong_parameters.scad, line 6
// expect: WARNING: Cylinder parameters ambiguous in file wrong_parameters.scad, line 7
// expect: WARNING: Unable to convert translate("a") parameter to a vec3 or vec2 of numbers in file wrong_parameters.scad, line 8
// expect: WARNING: Problem converting rotate(a="a") parameter in file wrong_parameters.scad, line 9
// expect: WARNING: When parameter a is supplied as vector, v is ignored rotate(a=[0, 0, 90], v=[1, 0, 0]) in file wrong_parameters.scad, line 10
// expect: WARNING: Unable to convert scale("a") parameter to a number, a vec3 or vec2 of numbers or a number in file wrong_parameters.scad, line 11
// expect: WARNING: Unable to convert mirror(1) parameter to a vec3 or vec2 of numbers in file wrong_parameters.scad, line 12
// expect: WARNING: Unable to parse color "nocolor" in file wrong_parameters.scad, line 13
// expect: Please see https://en.wikipedia.org/wiki/Web_colors
// expect: WARNING: color() expects numbers between 0.0 and 1.0. Value of 2.0 is out of range in file wrong_parameters.scad, line 14
// expect: WARNING: module cube() does not support child modules in file wrong_parameters.scad, line 15
// expect: WARNING: Unable to convert square(size=[1], ...) parameter to a number or a vec2 of numbers in file wrong_parameters.scad, line 16
// expect csg: cube(size = [1, 1, 1], center = false);
// expect csg: cube(size = [1, 1, 1], center = false);
// expect csg: cube(size = [1, 1, 1], center = true);
// expect csg: cube(size = [2, 2, 2], center = false);
// expect csg: cube(size = [1, 1, 1], center = false);
// expect csg: sphere($fn = 0, $fa = 12, $fs = 2, r = 2);
// expect csg: cylinder($fn = 0, $fa = 12, $fs = 2, h = 1, r1 = 2, r2 = 1, center = false);
// expect csg: multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: multmatrix([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: multmatrix([[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: color([-1, -1, -1, 1]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: color([2, 0, 0, 1]) {
// expect csg: \tcube(size = [1, 1, 1], center = false);
// expect csg: }
// expect csg: cube(size = [1, 1, 1], center = false);
// expect csg: square(size = [1, 1], center = false);
