// A page in percent: 2021.01 takes its viewBox for millimetres.
linear_extrude(1) import("percent.svg");
