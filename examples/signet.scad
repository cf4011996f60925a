// Signet ring: an oval face, flaring shoulders, a border line and initials cut
// into the face, mirrored so that the seal reads right in wax.
//
//   lamina examples/signet.scad -o signet.slc --layer 0.025
//   lamina examples/signet.scad -D 'initials="AB"' -D mirrored=false -o ab.slc
//
// Stands on the back of its shank, the face level on top.

use <lib/jewelry.scad>
use <lib/letters.scad>

/* [Size] */
ring_size = 60;
size_system = "ISO"; // [ISO, EU, US, UK, CH, JP, mm]

/* [Face] */
// length of the face along the finger [mm]
face_length = 13.5; // [8 : 0.5 : 18]
// width of the face across the finger [mm]
face_width = 11.5; // [8 : 0.5 : 18]
// metal between finger and face [mm]
face_thickness = 2.6; // [1.8 : 0.1 : 4]

/* [Engraving] */
// one to three letters, A to Z and &
initials = "LM";
// mirrored as a seal, so that the wax reads right
mirrored = true;
// depth of the cut [mm]
depth = 0.5; // [0.3 : 0.05 : 1]
// width of the graver's line [mm]
line = 0.6; // [0.3 : 0.05 : 1]

/* [Shank] */
// width at the back [mm]
width_back = 4; // [2 : 0.1 : 8]
// thickness at the back [mm]
thickness = 1.7; // [1.2 : 0.1 : 3]

/* [Facets] */
$fa = 5;
$fs = 0.35;

diameter = ring_diameter(ring_size, size_system);
face = diameter / 2 + face_thickness;  // height of the face over the axis
// The field inside the border, and the largest letters that keep off it.
margin = 0.75 + 1.6 * line;
field = [face_width, face_length] / 2 * (1 - 2 * margin / face_length);
nominal = field[1];
fit = norm([monogram_width(initials, nominal, line) / 2 / field[0],
            nominal / 2 / field[1]]);
letters_height = nominal * min(1, 0.96 / fit);

assert(face_thickness - depth >= 1.2,
       "less than 1.2 mm of metal would be left under the engraving");
assert(len(initials) <= 3, "a signet takes three letters at most");
assert(face_width < 1.6 * face, "the face is too wide for this finger");

// Shank that widens towards the face. Seen along the finger its outline runs
// from the face's edge in a straight line onto the round of the back.
module body() {
  n = 4 * ceil(facets(diameter / 2 + thickness) / 2);
  back = diameter / 2 + thickness;
  edge = [face_width / 2, face + 0.4];
  edge_away = atan2(edge[0], edge[1]);
  tangent_away = edge_away + acos(min(1, back / norm(edge)));
  ring_sweep([for (i = [0 : n - 1])
    let (away = abs(wrapped(360 * i / n - 90)),  // from the face
         w = mix(width_back, face_length + 1, smoothstep(115, 12, away)),
         r = away < edge_away
               ? edge[1] / cos(away)
               : back / cos(tangent_away - min(tangent_away, away)),
         dome = 0.04 + 0.22 * w * smoothstep(0.4 * edge_away, 1.9 * edge_away, away),
         p = shank_profile(w, r - diameter / 2, 0.15,
                           min(dome, 0.6 * (r - diameter / 2)),
                           dome_facets(width_back)))
    [for (q = p) [diameter / 2 + q[0], q[1]]]]);
}

// What the face's edge leaves of the body: an oval block, bevelled round the
// face, that flares downwards till it clears the shank. Along +y, in the ring's
// frame.
module oval_block() {
  bevel = 0.3;
  r = face_length / 2;
  low = 2 * face;
  rotate([-90, 0, 0]) translate([0, 0, face])
    scale([face_width / face_length, 1, 1])
      rotate_extrude()
        polygon(concat([[0, 0], [r - bevel, 0]],
                       [for (i = [0 : 16]) let (z = low * pow(i / 16, 2.2))
                          [r + 0.15 * z + 0.25 * z * z, -bevel - z]],
                       [[0, -bevel - low]]));
}

// 2D, as seen from above the face.
module engraving() {
  border = face_length - 1.5;
  scale([face_width / face_length, 1]) difference() {
    circle(d = border);
    circle(d = border - 2 * line);
  }
  mirror([mirrored ? 1 : 0, 0]) monogram(initials, letters_height, line);
}

module ring() {
  difference() {
    intersection() {
      body();
      oval_block($visible = true);
    }
    rotate([-90, 0, 0]) translate([0, 0, face - depth])
      linear_extrude(depth + 1, $visible = true) engraving();
  }
}

translate([0, 0, diameter / 2 + thickness]) stand_up() ring();
