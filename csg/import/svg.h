#pragma once
// SVG drawings, as OpenSCAD 2021.01 understands them.
//
// Shapes and paths in groups of any depth count, with their transforms, except
// below <defs>; fill, visibility, style sheets, <use> and <text> do not. Closed
// paths are filled, open ones drawn with the width, cap and join of their
// stroke. Curves become as many lines as in OpenSCAD, whatever $fn is.

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

struct SvgStroke {
  enum class Cap { kButt, kRound, kSquare };
  enum class Join { kMiter, kRound, kBevel };

  double width = 1;
  Cap cap = Cap::kSquare;
  Join join = Join::kMiter;
};

using SvgContours = std::vector<std::vector<Vec2>>;

struct SvgOptions {
  double dpi = 72;
  bool center = false;
  // Gives the outlines of a drawn path. It is a function, as plane geometry
  // stands above the readers.
  std::function<SvgContours(std::span<const Vec2> path, const SvgStroke&)>
      outline;
};

// Reads the contours of each shape, in millimetres, y up. A point is inside a
// shape where its contours enclose it an odd number of times; the drawing is
// the union of its shapes.
//
// throws  FormatError for malformed XML, and for groups nested too deep
std::vector<SvgContours> parse_svg(std::string_view bytes,
                                   const SvgOptions& options);

}  // namespace lamina::csg
