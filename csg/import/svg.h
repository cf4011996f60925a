#pragma once
// SVG drawings, as OpenSCAD understands them.
//
// Shapes and paths in groups of any depth count, with their transforms; fill,
// visibility and style sheets do not. Closed paths are filled, open ones drawn
// with the width, cap and join of their stroke. In 2026 nothing is drawn of an
// element with display:none, and <use> draws what <defs> hold. The caller
// decides by how many lines a curve is drawn.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "parser/language.h"

namespace lamina::csg {

struct SvgStroke {
  enum class Cap { kButt, kRound, kSquare };
  enum class Join { kMiter, kRound, kBevel };

  double width = 1;
  Cap cap = Cap::kSquare;
  Join join = Join::kMiter;
};

using SvgContours = std::vector<std::vector<Vec2>>;

// How many lines stand for a curve, at least. An ellipse has 40 or more, a
// Bézier curve 20, an arc one for each 18° and four more.
struct SvgCurves {
  // Lines of an arc of a circle; null: as many as above.
  std::function<int(double radius, double sweep_deg)> lines_of_arc = {};
  int lines_of_bezier = 0;
};

struct SvgOptions {
  double dpi = 72;
  bool center = false;
  // Gives the outlines of a drawn path. It is a function, as plane geometry
  // stands above the readers.
  std::function<SvgContours(std::span<const Vec2> path, const SvgStroke&)>
      outline = {};
  // Draws only the elements with this id, and only the layers of Inkscape with
  // this label; of both, the elements with the id in such a layer.
  std::optional<std::string> id = std::nullopt;
  std::optional<std::string> layer = std::nullopt;
  Language language = Language::k2021;
  SvgCurves curves = {};
};

struct SvgDrawing {
  // The contours of each shape, in millimetres, y up. A point is inside a shape
  // where its contours enclose it an odd number of times; the drawing is the
  // union of its shapes.
  std::vector<SvgContours> shapes;
  bool has_match = true;  // whether any element is what id and layer ask for
  // Elements that draw nothing, each kind once: "<text>", "<use> of '#a'".
  std::vector<std::string> undrawn;
};

// throws  FormatError for malformed XML, and for groups nested too deep
SvgDrawing parse_svg(std::string_view bytes, const SvgOptions& options);

}  // namespace lamina::csg
