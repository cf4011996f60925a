linear_extrude(1) text("L", halign = "default", valign = "default");
