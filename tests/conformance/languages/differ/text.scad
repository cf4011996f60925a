// The letters of a word stand otherwise; 2021.01 takes "default" with a warning.
linear_extrude(1) text("lamina", halign = "default", valign = "default");
