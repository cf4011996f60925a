linear_extrude(1) import("../newer/parts.svg", layer = "front");
