linear_extrude(1) import("corner.dxf", center = true);
