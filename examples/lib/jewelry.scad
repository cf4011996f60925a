// jewelry.scad: a goldsmith's parts, for OpenSCAD and lamina.
//
//   use <lib/jewelry.scad>
//
// Sizes, stones, settings, shanks and findings. All lengths are millimetres,
// all angles degrees. Nothing is drawn by this file itself; it has functions
// and modules only.
//
// Frames
//   ring     the finger's axis is z, the ring lies on its side, centred on the
//            origin; angles run counter-clockwise from +x. The head of a ring
//            sits at +y ("north"); `stand_up()` turns north to +z.
//   stone    z = 0 is the plane through the middle of the girdle, +z is the
//            table. Every stone, seat, head and bezel uses this frame, so that
//            one transform places them all. `$rigid = true` for a seat keeps its
//            size where lamina's --scale enlarges the rest for casting.
//
// Facets follow $fn, or $fa and $fs, everywhere, sweeps included.
//
// Bench rules behind the defaults (usual requirements of casting houses):
//   walls and bezels ≥ 0.8, prongs ≥ 0.7 thick, openings ≥ 0.4, parts that
//   shall fuse overlap by ≥ 0.15, engraving ≥ 0.3 wide and 0.4 deep, metal
//   under a culet ≥ 0.5, a bearing takes at most a quarter of the prong, and
//   the dome of a prong begins at the height of the table.

// === Small helpers =======================================================

// Number of facets of a full circle of radius r, as OpenSCAD counts them.
function facets(r) =
  $fn > 0 ? max(3, floor($fn))
          : ceil(max(5, min(360 / $fa, 2 * PI * r / $fs)));

// Facets of an arc: at least two, even, so that its middle is a vertex.
function arc_facets(r, angle) =
  2 * max(1, ceil(facets(r) * abs(angle) / 720));

// 0 for x <= a, 1 for x >= b, smooth between.
function smoothstep(a, b, x) =
  let (t = min(1, max(0, (x - a) / (b - a)))) t * t * (3 - 2 * t);

function mix(a, b, t) = a + (b - a) * t;

// Angle between -180 and 180.
function wrapped(angle) = angle - 360 * floor((angle + 180) / 360);

// Turns a ring from its side to its feet: north up, centred on the origin.
module stand_up() { rotate([90, 0, 0]) children(); }

// Children `count` times around z, the first at angle `start`.
module around(count, start = 0) {
  assert(count >= 1, "around: count must be at least 1");
  for (i = [0 : count - 1]) rotate([0, 0, start + 360 * i / count]) children();
}

// Places children of the stone frame on a ring: girdle plane at `radius`, the
// table outwards, at `angle` (90 = north), shifted along the finger by `shift`.
module on_ring(radius, angle = 90, shift = 0) {
  rotate([0, 0, angle]) translate([radius, 0, shift]) rotate([0, 90, 0])
    children();
}

// === Ring sizes ==========================================================
//
// Each function gives the inner diameter.

// ISO 8653 (also EN and DIN): the size is the inner circumference in mm, that
// of the largest cylinder that goes through the ring.
function ring_diameter_iso(size) =
  assert(is_num(size) && size >= 38 && size <= 80,
         str("ISO ring size is a circumference of 38 to 80 mm, got ", size))
  size / PI;

// USA and Canada: 0.458 in at size 0, 0.032 in (0.8128 mm) more per size, the
// rule of the trade's ring sticks, rounded as usual to 11.63 mm.
function ring_diameter_us(size) =
  assert(is_num(size) && size >= 0 && size <= 16,
         str("US ring size is a number from 0 to 16, got ", size))
  11.63 + 0.8128 * size;

// United Kingdom, Ireland, Australia (BS 6820:1987): C has a circumference of
// 40 mm, each letter has 1.25 mm more. `size` is a string: "N", "N 1/2",
// "N1/2", "N½", "Z+2".
function ring_diameter_uk(size) =
  assert(is_string(size) && len(size) >= 1 && ord(size[0]) >= ord("A")
           && ord(size[0]) <= ord("Z"),
         str("UK ring size is a capital letter, perhaps with 1/2, as in ",
             "\"N 1/2\", got ", size))
  let (letter = ord(size[0]) - ord("C"),
       rest = [for (i = [1 : 1 : len(size) - 1]) if (size[i] != " ") size[i]],
       half = rest == ["½"] || rest == ["1", "/", "2"] ? 0.5 : 0,
       above_z = size[0] == "Z" && len(rest) == 2 && rest[0] == "+"
                   ? ord(rest[1]) - ord("0") : 0)
  assert(len(rest) == 0 || half > 0 || above_z > 0,
         str("UK ring size ends in 1/2, ½ or (after Z) +1 … +9, got ", size))
  (40 + 1.25 * (letter + half + above_z)) / PI;

// Switzerland, Italy, Spain: circumference in mm less 40.
function ring_diameter_swiss(size) = ring_diameter_iso(size + 40);

// Japan (JIS S 4700): size 1 is 13 mm, each size has 1/3 mm more diameter.
function ring_diameter_jp(size) =
  assert(is_num(size) && size >= 1 && size <= 30,
         str("Japanese ring size is a number from 1 to 30, got ", size))
  (size + 38) / 3;

// Any of them: system is "ISO" (= "EU"), "US", "UK", "CH", "JP" or "mm".
function ring_diameter(size, system = "ISO") =
  system == "ISO" || system == "EU" ? ring_diameter_iso(size) :
  system == "US" ? ring_diameter_us(size) :
  system == "UK" ? ring_diameter_uk(size) :
  system == "CH" ? ring_diameter_swiss(size) :
  system == "JP" ? ring_diameter_jp(size) :
  system == "mm" ? assert(is_num(size) && size >= 12 && size <= 26,
                          str("inner diameter is 12 to 26 mm, got ", size))
                   size :
  assert(false, str("ring size system is ISO, EU, US, UK, CH, JP or mm, got ",
                    system)) undef;

// === Round brilliants ====================================================
//
// Proportions of a well made round brilliant, as parts of its diameter.

function brilliant_table() = 0.57;
function brilliant_crown() = 0.15;     // girdle's edge to table
function brilliant_pavilion() = 0.43;  // girdle's edge to culet
function brilliant_girdle() = 0.025;   // thickness of the girdle

// Weight of a diamond: carat = d² · depth · 0.0061 (the gemmologists' rule)
// with depth = 0.605 d, that is 0.0037 d³. One carat is 6.47 mm.
function brilliant_carat(d) = 0.0037 * pow(d, 3);
function brilliant_diameter(carat) =
  assert(is_num(carat) && carat > 0 && carat <= 30,
         str("a stone weighs more than 0 and at most 30 carat, got ", carat))
  pow(carat / 0.0037, 1 / 3);

// Heights over the girdle's middle plane.
function table_height(d) = d * (brilliant_girdle() / 2 + brilliant_crown());
function culet_depth(d) = d * (brilliant_girdle() / 2 + brilliant_pavilion());

// The stone itself with its 57 facets, to be shown, not printed: `%brilliant(d)`.
module brilliant(d) {
  assert(d > 0, "brilliant: d must be positive");
  g = brilliant_girdle() / 2;
  rt = brilliant_table() / 2;
  // Stars end where kites meet; lower halves reach 75 % of the way to the culet.
  rs = mix(rt, 0.5, 0.52);
  zs = g + brilliant_crown() * 0.52;
  rl = 0.5 * 0.27;
  zl = -g - brilliant_pavilion() * 0.75;
  function ring(r, z, n, shift) =
    [for (i = [0 : n - 1]) let (a = 360 * (i + shift) / n)
       [r * cos(a), r * sin(a), z]];
  // 0-7 table, 8-15 stars, 16-31 girdle above, 32-47 below, 48-55 lower, 56 culet
  points = concat(ring(rt, g + brilliant_crown(), 8, 0), ring(rs, zs, 8, 0.5),
                  ring(0.5, g, 16, 0), ring(0.5, -g, 16, 0),
                  ring(rl, zl, 8, 0.5), [[0, 0, -g - brilliant_pavilion()]]);
  faces = concat(
    [[for (i = [7 : -1 : 0]) i]],
    [for (i = [0 : 7]) let (n = (i + 1) % 8, u = 16 + 2 * i, l = 32 + 2 * i,
                            un = 16 + (2 * i + 2) % 16, ln = 32 + (2 * i + 2) % 16)
       each [[i, n, 8 + i],                               // star
             [i, 8 + i, u], [n, un, 8 + i],               // halves of two kites
             [8 + i, u + 1, u], [8 + i, un, u + 1],       // upper halves
             [u, u + 1, l + 1], [u, l + 1, l],            // girdle
             [u + 1, un, ln], [u + 1, ln, l + 1],
             [l, l + 1, 48 + i], [l + 1, ln, 48 + i],     // lower halves
             [l, 48 + i, 56], [ln, 56, 48 + i]]]);        // halves of two mains
  scale(d) polyhedron(points, faces, convexity = 2);
}

// What is cut away for a round stone: one solid of revolution with the
// bearing (pavilion cone and girdle), the opening above it and a culet hole.
//
// d          diameter of the stone
// clearance  play around girdle and pavilion; casting shrinks, setters file
// bite       how far metal may reach over the girdle's edge: prongs and bezels
//            keep this much, so the stone clicks under them; 0 = open seat
// above      height of the opening over the girdle plane
// hole       diameter of the hole under the culet (azure); 0 = none
// below      depth of that hole under the girdle plane
module seat_cutter(d, clearance = 0.04, bite = 0, above = 0, hole = 0,
                   below = 0) {
  assert(d >= 0.7, str("seat_cutter: stones under 0.7 mm are not set, got ", d));
  assert(bite >= 0 && bite < d / 4, "seat_cutter: bite must be 0 to d/4");
  assert(hole < d, "seat_cutter: the hole must be smaller than the stone");
  rg = d / 2 + clearance;
  g = d * brilliant_girdle() / 2;
  slope = brilliant_pavilion() / 0.5;  // of the pavilion
  crown = brilliant_crown() / (0.5 - brilliant_table() / 2);
  top = max(above, table_height(d) + 0.3);
  rh = hole / 2;
  tip = -g - slope * rg;
  hole_top = -g - slope * (rg - rh);
  bottom = min(-below, hole_top - 0.01);
  $support = "none";  // it would scar the bearing
  rotate_extrude()
    polygon(concat(hole > 0 ? [[0, bottom], [rh, bottom], [rh, hole_top]]
                            : [[0, tip]],
                   [[rg, -g], [rg, g]],
                   bite > 0 ? [[rg - bite, g + crown * bite]] : [],
                   [[rg - bite, top], [0, top]]));
}

// === Settings ============================================================

// A rod from a to b, radius ra at a and rb at b; round tips where asked.
module rod(a, b, ra, rb, round_a = false, round_b = false) {
  v = b - a;
  l = norm(v);
  assert(l > 0, "rod: its ends must differ");
  translate(a) rotate([0, acos(v[2] / l), atan2(v[1], v[0])]) {
    cylinder(r1 = ra, r2 = rb, h = l);
    if (round_a) sphere(ra);
    if (round_b) translate([0, 0, l]) sphere(rb);
  }
}

// A ring of round wire in the xy plane; radius to the middle of the wire.
module wire_ring(radius, wire) {
  assert(radius > wire / 2, "wire_ring: radius must exceed half the wire");
  rotate_extrude() translate([radius, 0]) circle(d = wire);
}

// Basket head for a round stone, in the stone's frame.
//
// prongs  how many, usually 4 or 6; the first stands at angle `turn`
// wire    their thickness at the top; they swell by a fifth to the foot
// depth   from the girdle plane down to the foot (0: to the culet + 0.6)
// lean    outward lean of the prongs
// Two rails tie the prongs: the gallery just under the girdle's bearing and
// the base. Cut it with `seat_cutter(d, bite = prong_bite(wire), …)`.
module prong_head(d, prongs = 6, wire = 1.0, depth = 0, lean = 9, turn = 0,
                  rail = 0.9) {
  assert(prongs >= 3, "prong_head: at least 3 prongs hold a stone");
  assert(wire >= 0.7, str("prong_head: a prong is at least 0.7 mm, got ", wire));
  foot = depth > 0 ? depth : culet_depth(d) + 0.6;
  top = table_height(d);
  // The bearing reaches a quarter of the wire into the prong.
  r0 = d / 2 + wire / 4;
  function at(z) = r0 + tan(lean) * z;
  around(prongs, turn)
    rod([at(-foot), 0, -foot], [at(top), 0, top], wire * 0.6, wire / 2,
        round_a = false, round_b = true);
  gallery = -0.17 * d;
  translate([0, 0, gallery]) wire_ring(at(gallery), rail);
  translate([0, 0, -foot + rail / 2]) wire_ring(at(-foot + rail / 2), rail);
}

// Depth to which a bearing may cut a prong of this thickness.
function prong_bite(wire) = wire / 4;

// Bezel for a round stone, in the stone's frame: a collet from `depth` under
// the girdle to `lip` over it, `wall` thick, drawn in by `taper` towards the
// foot. Cut it with `seat_cutter`.
module bezel(d, wall = 0.8, depth = 0, lip = 0, taper = 6) {
  assert(wall >= 0.8, str("bezel: a wall is at least 0.8 mm, got ", wall));
  foot = depth > 0 ? depth : culet_depth(d) + 0.5;
  top = lip > 0 ? lip : 0.1 * d + 0.2;
  r = d / 2 + wall;
  rotate_extrude()
    polygon([[0, -foot], [r - tan(taper) * foot, -foot], [r, 0], [r, top],
             [0, top]]);
}

// Bullet for bead setting: a round post along z with a dome, one solid of
// revolution. Its foot lies `sunk` under z = 0, the dome begins at `height`.
module grain(d, height = 0, sunk = 0.3) {
  assert(d > 0 && sunk + height > 0, "grain: d and sunk + height must be positive");
  n = arc_facets(d / 2, 90);
  rotate_extrude()
    polygon(concat([[0, -sunk], [d / 2, -sunk]],
                   [for (i = [0 : n - 1]) let (a = 90 * i / n)
                      [d / 2 * cos(a), height + d / 2 * sin(a)]],
                   [[0, height + d / 2]]));
}

// Milgrain: beads of diameter `bead` on a circle, nearly touching.
module milgrain(radius, bead = 0.7, angle = 360) {
  count = floor(2 * PI * radius * angle / 360 / (bead * 1.05));
  for (i = [0 : (angle == 360 ? count - 1 : count)])
    rotate([0, 0, angle * i / count]) translate([radius, 0, 0]) sphere(d = bead);
}

// === Shanks ==============================================================

// Facets of the dome of a shank.
function dome_facets(width) = max(6, arc_facets(width / 2, 90));

// Cross-sections of shanks: counter-clockwise points [r, z], r counted from
// the inner side of the ring outwards, z along the finger.
//   inner, outer  rise of the comfort curve inside and of the dome outside
//   facets        of each of the two arcs; 0: as $fa and $fs ask
function shank_profile(width, thickness, inner, outer, facets = 0) =
  assert(width >= 0.8 && thickness >= 0.8,
         str("a shank is at least 0.8 × 0.8 mm, got ", width, " × ", thickness))
  assert(inner >= 0 && outer >= 0 && inner + outer < thickness,
         "shank_profile: the curves inner + outer must be less than the thickness")
  let (n = facets > 0 ? facets : dome_facets(width))
  concat([for (i = [0 : n]) let (a = -90 + 180 * i / n)
            [thickness - outer * (1 - cos(a)), width / 2 * sin(a)]],
         [for (i = [0 : n]) let (a = 90 - 180 * i / n)
            [inner * (1 - cos(a)), width / 2 * sin(a)]]);

// Flat wire with broken edges.
function flat_profile(width, thickness, edge = 0.2) =
  let (w = width / 2, e = edge)
  [[0, -w + e], [e, -w], [thickness - e, -w], [thickness, -w + e],
   [thickness, w - e], [thickness - e, w], [e, w], [0, w - e]];

// D-shape: flat inside, domed outside.
function d_profile(width, thickness) =
  let (w = width / 2, n = dome_facets(width), dome = thickness * 0.65)
  concat([[0, -w]],
         [for (i = [0 : n]) let (a = -90 + 180 * i / n)
            [thickness - dome * (1 - cos(a)), w * sin(a)]],
         [[0, w]]);

// Court: domed outside, comfort curve inside.
function court_profile(width, thickness) =
  shank_profile(width, thickness, thickness * 0.15, thickness * 0.55);

// Plain band of a profile; `angle` < 360 gives an arc from +x.
module band(diameter, profile, angle = 360) {
  assert(diameter > 0, "band: diameter must be positive");
  rotate_extrude(angle = angle)
    polygon([for (p = profile) [diameter / 2 + p[0], p[1]]]);
}

// Ring swept from cross-sections that change on the way: sections[i] is a
// list of points [radius, z] at angle 360·i/len(sections), all of one length,
// counter-clockwise. Radii are absolute.
module ring_sweep(sections) {
  n = len(sections);
  m = len(sections[0]);
  points = [for (i = [0 : n - 1]) let (c = cos(360 * i / n), s = sin(360 * i / n))
              for (p = sections[i]) [p[0] * c, p[0] * s, p[1]]];
  faces = [for (i = [0 : n - 1]) let (a = i * m, b = (i + 1) % n * m)
             for (j = [0 : m - 1]) let (k = (j + 1) % m)
               each [[a + j, a + k, b + k], [a + j, b + k, b + j]]];
  polyhedron(points, faces, convexity = 6);
}

// Round wire along a closed curve around z; path[i] are points, the radius
// from z is never 0. The wire's cross-section stands square to the curve.
module wire_loop(path, wire) {
  n = len(path);
  m = 4 * ceil(facets(wire / 2) / 4);
  function unit(v) = v / norm(v);
  points = [for (i = [0 : n - 1])
              let (p = path[i],
                   t = unit(path[(i + 1) % n] - path[(i + n - 1) % n]),
                   out = [p[0], p[1], 0],
                   u = unit(out - t * (out * t)),
                   v = cross(t, u))
              for (j = [0 : m - 1])
                p + wire / 2 * (u * cos(360 * j / m) + v * sin(360 * j / m))];
  faces = [for (i = [0 : n - 1]) let (a = i * m, b = (i + 1) % n * m)
             for (j = [0 : m - 1]) let (k = (j + 1) % m)
               each [[a + j, b + k, a + k], [a + j, b + j, b + k]]];
  polyhedron(points, faces, convexity = 10);
}

// === Findings ============================================================

// Jump ring of round wire, axis along z.
module jump_ring(inner = 3, wire = 1) {
  assert(wire >= 0.8, str("jump_ring: wire is at least 0.8 mm, got ", wire));
  wire_ring(inner / 2 + wire / 2, wire);
}

// Bail: a flattened loop, broad at the front, narrow at the foot, through
// which the chain runs along x. Its hole is `opening` wide (y) and 1.4 times
// as high (z … the long way of the pendant); the foot is at the origin and the
// loop rises along +y.
module bail(opening = 3, broad = 3.2, narrow = 1.6, wall = 1) {
  assert(wall >= 0.8, str("bail: a wall is at least 0.8 mm, got ", wall));
  stretch = 1.5;
  n = 2 * arc_facets(opening / 2 + wall, 360);
  translate([0, stretch * (opening / 2 + wall), 0]) rotate([0, 90, 0])
    scale([1, stretch, 1])
      ring_sweep([for (i = [0 : n - 1])
        let (a = 360 * i / n,
             w = mix(narrow, broad, (1 + sin(a)) / 2),
             p = shank_profile(w, wall, 0.12 * wall, 0.45 * wall,
                               dome_facets(broad)))
        [for (q = p) [opening / 2 + q[0], q[1]]]]);
}

// Knuckle of a hinge: a tube along z from z = 0, for a pin of diameter `pin`.
// `cut = true` gives the pin's hole alone, long enough to pass through.
module knuckle(pin = 0.8, wall = 0.8, length = 1.2, cut = false) {
  assert(wall >= 0.8, str("knuckle: a wall is at least 0.8 mm, got ", wall));
  if (cut) translate([0, 0, -0.5]) cylinder(d = pin + 0.1, h = length + 1);
  else cylinder(d = pin + 0.1 + 2 * wall, h = length);
}
