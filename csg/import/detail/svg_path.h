#pragma once
// The path language of SVG: "M 0,0 h 3 c …".

#include <string_view>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

struct SvgSubpath {
  std::vector<Vec2> points;
  bool is_drawn = false;  // open, so drawn as a stroke
};

// A curve becomes 20 lines, an arc one for each 18° and four more.
std::vector<SvgSubpath> parse_svg_path(std::string_view data);

}  // namespace lamina::csg
