linear_extrude(1) import("parts.svg", id = "small");
