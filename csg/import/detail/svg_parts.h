#pragma once
// Attributes of SVG elements: the page, paths, transforms, strokes.

#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <pugixml.hpp>

#include "base/vec.h"
#include "csg/import/svg.h"

namespace lamina::csg {

// The page of a drawing: from the drawing's units to millimetres.
struct SvgPage {
  double height = 0;  // mm
  Vec2 scale = Vec2(1);
  Vec2 shift = Vec2(0);     // of the viewBox on the page [mm]
  Vec2 view_low = Vec2(0);  // of the viewBox; of a page in percent its share
};

// Reads width, height, viewBox and preserveAspectRatio of an <svg> element.
SvgPage read_svg_page(const pugi::xml_node& svg, double dpi, Language rules);

// The lines that stand for an ellipse, and for an arc of one.
//
// radius  the greater one, in the drawing's units
int lines_of_ellipse(const SvgCurves& curves, double radius);
int lines_of_arc(const SvgCurves& curves, double radius, double sweep_deg);
int lines_of_bezier(const SvgCurves& curves);

struct SvgSubpath {
  std::vector<Vec2> points;
  bool is_drawn = false;  // open, so drawn as a stroke
};

// Reads a path: "M 0,0 h 3 c …".
std::vector<SvgSubpath> parse_svg_path(std::string_view data,
                                       const SvgCurves& curves);

// What an element says of its own look: `transform`, display, strokes.

// The matrix of a transform attribute: "rotate(90) scale(2)".
glm::dmat3 read_svg_transforms(std::string_view text);

bool has_display_none(const pugi::xml_node& element);

SvgStroke read_svg_stroke(const pugi::xml_node& element, Language language);

}  // namespace lamina::csg
