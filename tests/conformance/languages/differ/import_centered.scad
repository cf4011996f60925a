linear_extrude(1) import("../newer/corner.dxf", center = true);
