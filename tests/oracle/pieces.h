#pragma once
// Pieces of kinds that differ, for judges of walls and thickness.

namespace lamina::oracle {

inline constexpr const char* kPieces[] = {
    // Smooth, with a flat bottom.
    "difference() { sphere(9, $fn = 60); translate([0, 0, -19]) "
    "cube(20, center = true); }",
    // A signet: a band and a head that meet in inner edges.
    "difference() { union() { rotate([90, 0, 0]) cylinder(r = 11, h = 8, "
    "center = true, $fn = 72); translate([0, 0, 9]) cube([16, 12, 8], "
    "center = true); } rotate([90, 0, 0]) cylinder(r = 6, h = 30, center = "
    "true, $fn = 72); }",
    // Twisted, with edges that lean.
    "linear_extrude(20, twist = 90, slices = 40) difference() { square(14, "
    "center = true); translate([4, 0]) square([8, 3]); }",
    // Corners of many faces, and a cavity of the design's own.
    "difference() { rotate([20, 30, 5]) cylinder(r1 = 10, r2 = 5, h = 18, $fn "
    "= 7); translate([2, 3, 8]) sphere(2, $fn = 24); }",
    // A branched body.
    "for (a = [0 : 72 : 359]) rotate([0, 60, a]) cylinder(r1 = 6, r2 = 5, h = "
    "14, $fn = 24); sphere(7, $fn = 40);",
};

}  // namespace lamina::oracle
