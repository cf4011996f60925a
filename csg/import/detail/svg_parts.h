#pragma once
// Attributes of SVG elements that have a language of their own.

#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "base/vec.h"

namespace lamina::csg {

// The page of a drawing: from the drawing's units to millimetres.
struct SvgPage {
  double height = 0;  // mm
  Vec2 scale = Vec2(1);
  Vec2 shift = Vec2(0);     // of the viewBox on the page [mm]
  Vec2 view_low = Vec2(0);  // of the viewBox
};

// Reads width, height, viewBox and preserveAspectRatio of an <svg> element.
SvgPage read_svg_page(const pugi::xml_node& svg, double dpi);

struct SvgSubpath {
  std::vector<Vec2> points;
  bool is_drawn = false;  // open, so drawn as a stroke
};

// Reads a path: "M 0,0 h 3 c …". A curve becomes 20 lines, an arc one for each
// 18° and four more.
std::vector<SvgSubpath> parse_svg_path(std::string_view data);

}  // namespace lamina::csg
