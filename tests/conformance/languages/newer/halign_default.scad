linear_extrude(1) text("lamina", halign = "default", valign = "default");
