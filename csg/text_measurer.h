#pragma once
// What textmetrics() and fontmetrics() return, and who measures it.
//
// The evaluator does not know fonts; it is given a measurer. The functions are
// newer than OpenSCAD 2021.01. They describe text() here, which is that of
// 2021.01; later releases set letters 2.4% further apart.

#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "csg/tree.h"

namespace lamina::csg {

// Lengths are in mm, y up.
struct TextMetrics {
  Vec2 position = Vec2(0);  // of the box around the text, its lower left corner
  Vec2 size = Vec2(0);
  double ascent = 0;       // of the highest letter above the baseline
  double descent = 0;      // of the lowest one; negative below the baseline
  Vec2 offset = Vec2(0);   // by which alignment moves the text
  Vec2 advance = Vec2(0);  // to where a further letter would stand
};

struct FontMetrics {
  double nominal_ascent = 0;  // of most letters
  double nominal_descent = 0;
  double max_ascent = 0;  // of all letters
  double max_descent = 0;
  double interline = 0;  // from one baseline to the next
  std::string family;
  std::string style;
};

class TextMeasurer {
 public:
  virtual ~TextMeasurer() = default;

  // warnings  gets what is wrong with the parameters
  // returns   no value where the font is missing
  // throws    GeometryError where the font libraries are missing
  virtual std::optional<TextMetrics> measure_text(
      const TextParams& params, std::vector<std::string>& warnings) = 0;
  virtual std::optional<FontMetrics> measure_font(
      const TextParams& params, std::vector<std::string>& warnings) = 0;
};

}  // namespace lamina::csg
