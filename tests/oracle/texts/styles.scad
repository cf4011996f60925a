// Fonts, styles, kerning, ligatures, curves, sizes, a font that is missing.
linear_extrude(1) {
  text("AVATar", size = 7);
  translate([0, 15]) text("Gold", font = "Liberation Serif:style=Bold Italic", size = 9, $fn = 40);
  translate([0, 30]) text("officiella", font = "DejaVu Sans", size = 6, spacing = 1.1);
  translate([0, 45]) text("Ring 57 \u2116 ø", font = "Liberation Mono", size = 5, $fa = 3, $fs = 0.1);
  translate([60, 60]) text("ebR", size = -6);
  translate([60, 0]) text("Q&A", font = "No Such Font", halign = "center", valign = "center");
  translate([60, 15]) text("Å\u030a\u00e9", font = "Arial:bold", $fn = 3);
}
