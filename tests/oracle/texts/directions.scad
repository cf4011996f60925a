// Columns and rows in every alignment; scripts that join their letters.
linear_extrude(1) {
  for (i = [0:2], j = [0:3]) {
    h = ["left", "center", "right"][i];
    v = ["top", "center", "baseline", "bottom"][j];
    translate([i * 40, j * 40]) text("gÅ", size = 6, direction = "ttb", halign = h, valign = v);
    translate([i * 40 + 15, j * 40]) text("jO", size = 6, direction = "btt", halign = h, valign = v, spacing = 1.3);
  }
  translate([0, 170]) text("الذهب", font = "Amiri", size = 12, halign = "right");
  translate([20, 170]) text("שלום", font = "DejaVu Sans", size = 8);
  translate([80, 170]) text("abc", size = 8, direction = "rtl", valign = "top");
}
