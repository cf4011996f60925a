#pragma once
// SVG drawings, as OpenSCAD 2021.01 understands them.
//
// Shapes and paths of any nesting of groups, with their transforms, count where
// they are no part of <defs>; fill, visibility, style sheets, <use> and <text>
// do not. What is closed is filled, what is open is drawn with the width, cap
// and join of its stroke. Curves become as many lines as there, whatever $fn.

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
  // The outlines of a drawn path. Planar geometry knows how.
  std::function<SvgContours(std::span<const Vec2> path, const SvgStroke&)>
      outline;
};

// The contours of each shape, in millimetres, y up. A point is inside a shape
// where its contours enclose it an odd number of times; the drawing is the
// union of its shapes.
//
// throws  FormatError for what is no XML, and for groups in groups without end
std::vector<SvgContours> parse_svg(std::string_view bytes,
                                   const SvgOptions& options);

}  // namespace lamina::csg
