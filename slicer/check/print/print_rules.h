#pragma once
// By which rules the layer graph judges a print.

namespace lamina::slicer {

struct PrintRules {
  // How far a layer may stand out over the one below before that is reported
  // [mm]; 0: as far as a surface of 45° does.
  double self_supporting = 0;
  // What is smaller is too small to matter, whatever it is: a pixel of the
  // printer where that is known [mm²], and one in a layer [mm³].
  double least_area = 0.001;
  double least_volume = 0.0005;
};

}  // namespace lamina::slicer
