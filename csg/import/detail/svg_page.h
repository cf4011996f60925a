#pragma once
// The page of an SVG drawing: from the drawing's units to millimetres.

#include <pugixml.hpp>

#include "base/vec.h"

namespace lamina::csg {

struct SvgPage {
  double height = 0;  // mm
  Vec2 scale = Vec2(1);
  Vec2 shift = Vec2(0);     // of the viewBox on the page [mm]
  Vec2 view_low = Vec2(0);  // of the viewBox
};

// Reads width, height, viewBox and preserveAspectRatio of an <svg> element.
SvgPage read_svg_page(const pugi::xml_node& svg, double dpi);

}  // namespace lamina::csg
