// display:none hides, and <use> repeats.
linear_extrude(1) import("../newer/parts.svg");
