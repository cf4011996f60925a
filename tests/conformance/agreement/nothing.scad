// openscad makes nothing
difference() {
  cube(1);
  cube(3, center = true);
}
