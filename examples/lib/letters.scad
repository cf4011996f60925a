// letters.scad: engraver's block capitals from strokes.
//
//   use <lib/letters.scad>
//   monogram("LM", height = 6, stroke = 0.7);
//
// 2D. A glyph is a list of polylines on a grid 4 wide and 6 high; a stroke is
// a round graver's line along them. Made of squares and circles only, so it
// needs no font and engraves alike on every machine.

// Points of an arc with centre c, radii rx and ry, from angle a to angle b.
function arc(c, rx, ry, a, b, n = 10) =
  [for (i = [0 : n]) let (t = a + (b - a) * i / n)
     [c[0] + rx * cos(t), c[1] + ry * sin(t)]];

function glyph(letter) =
  letter == "A" ? [[[0, 0], [2, 6], [4, 0]], [[0.75, 2.25], [3.25, 2.25]]] :
  letter == "B" ? [concat([[0, 0], [0, 6]], arc([2, 4.6], 1.6, 1.4, 90, -90), [[0, 3.2]]),
                   concat([[2, 3.2]], arc([2.2, 1.6], 1.8, 1.6, 90, -90), [[0, 0]])] :
  letter == "C" ? [arc([2.2, 3], 2.2, 3, 50, 310)] :
  letter == "D" ? [concat([[0, 0], [0, 6], [1.4, 6]], arc([1.4, 3], 2.6, 3, 90, -90), [[0, 0]])] :
  letter == "E" ? [[[3.6, 6], [0, 6], [0, 0], [3.6, 0]], [[0, 3.1], [3, 3.1]]] :
  letter == "F" ? [[[3.6, 6], [0, 6], [0, 0]], [[0, 3.1], [3, 3.1]]] :
  letter == "G" ? [concat(arc([2.2, 3], 2.2, 3, 50, 360), [[2.6, 3]])] :
  letter == "H" ? [[[0, 0], [0, 6]], [[4, 0], [4, 6]], [[0, 3], [4, 3]]] :
  letter == "I" ? [[[2, 0], [2, 6]], [[1, 0], [3, 0]], [[1, 6], [3, 6]]] :
  letter == "J" ? [concat([[3.4, 6], [3.4, 1.7]], arc([1.7, 1.7], 1.7, 1.7, 0, -170))] :
  letter == "K" ? [[[0, 0], [0, 6]], [[4, 6], [0, 2.4]], [[1.3, 3.6], [4, 0]]] :
  letter == "L" ? [[[0, 6], [0, 0], [3.6, 0]]] :
  letter == "M" ? [[[0, 0], [0.3, 6], [2.3, 1], [4.3, 6], [4.6, 0]]] :
  letter == "N" ? [[[0, 0], [0, 6], [4, 0], [4, 6]]] :
  letter == "O" ? [arc([2.2, 3], 2.2, 3, 0, 360, 20)] :
  letter == "P" ? [concat([[0, 0], [0, 6]], arc([2.2, 4.4], 1.7, 1.6, 90, -90), [[0, 2.8]])] :
  letter == "Q" ? [arc([2.2, 3], 2.2, 3, 0, 360, 20), [[2.6, 1.6], [4.2, -0.4]]] :
  letter == "R" ? [concat([[0, 0], [0, 6]], arc([2.2, 4.4], 1.7, 1.6, 90, -90), [[0, 2.8]]),
                   [[2, 2.8], [4, 0]]] :
  letter == "S" ? [concat(arc([2, 4.5], 1.9, 1.5, 40, 270), arc([2, 1.5], 2, 1.5, 90, -140))] :
  letter == "T" ? [[[0, 6], [4, 6]], [[2, 6], [2, 0]]] :
  letter == "U" ? [concat([[0, 6], [0, 2]], arc([2, 2], 2, 2, 180, 360), [[4, 6]])] :
  letter == "V" ? [[[0, 6], [2, 0], [4, 6]]] :
  letter == "W" ? [[[0, 6], [1.2, 0], [2.6, 5], [4, 0], [5.2, 6]]] :
  letter == "X" ? [[[0, 0], [4, 6]], [[0, 6], [4, 0]]] :
  letter == "Y" ? [[[0, 6], [2, 3], [4, 6]], [[2, 3], [2, 0]]] :
  letter == "Z" ? [[[0, 6], [4, 6], [0, 0], [4, 0]]] :
  letter == "&" ? [concat([[4, 0]], arc([1.9, 4.8], 1.1, 1.2, 215, -35),
                          arc([1.8, 1.6], 1.8, 1.6, 130, 330))] :
  assert(false, str("letters: no glyph for \"", letter, "\": A to Z and & only"))
  undef;

// Rightmost x of a glyph, on the grid.
function glyph_width(letter) =
  max([for (line = glyph(letter)) for (p = line) p[0]]);

// Left edges of the letters of a text, and the end of the last one.
function advances(text, gap, i = 0, x = 0) =
  i == len(text) ? [x - gap]
                 : concat([x], advances(text, gap, i + 1,
                                        x + glyph_width(text[i]) + gap));

// Width over all of `monogram` with the same parameters.
function monogram_width(text, height = 6, stroke = 0.6, gap = 0.3) =
  (height - stroke) / 6 * advances(text, 6 * gap)[len(text)] + stroke;

// A round stroke from a to b.
module stroke(a, b, width) {
  v = b - a;
  translate(a) {
    circle(d = width);
    if (norm(v) > 0)
      rotate(atan2(v[1], v[0])) translate([0, -width / 2])
        square([norm(v), width]);
  }
  translate(b) circle(d = width);
}

// Letters side by side, centred on the origin. `height` is that of the
// capitals over all, `stroke` the width of the line, `gap` a share of height.
module monogram(text, height = 6, stroke = 0.6, gap = 0.3) {
  assert(is_string(text) && len(text) > 0, "monogram: text must not be empty");
  assert(stroke >= 0.3,
         str("monogram: an engraved line is at least 0.3 mm wide, got ", stroke));
  s = (height - stroke) / 6;
  x = advances(text, 6 * gap);
  width = x[len(text)];
  for (i = [0 : len(text) - 1])
    for (line = glyph(text[i]))
      for (k = [0 : len(line) - 2])
        stroke(s * (line[k] + [x[i] - width / 2, -3]),
               s * (line[k + 1] + [x[i] - width / 2, -3]), stroke);
}
