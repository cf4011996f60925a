#pragma once
// Colours of a picture of a solid: OpenSCAD's schemes by their names, and
// materials of jewelers.

#include <string>
#include <string_view>
#include <vector>

#include "slicer/picture/image.h"

namespace lamina::slicer {

struct ColorScheme {
  std::string_view name;
  Rgb background_top;  // of the picture
  Rgb background_bottom;
  Rgb solid;
  double shine;  // share of the light that is mirrored, 0 … 1
};

// Null where no scheme has that name.
const ColorScheme* find_color_scheme(std::string_view name);

std::vector<std::string> color_scheme_names();

}  // namespace lamina::slicer
