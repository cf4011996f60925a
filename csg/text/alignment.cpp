#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "csg/text/detail/glyph_row.h"

namespace lamina::text {
namespace {

struct Choice {
  std::string_view word;
  double place;
};

// The place of the word; 0, with a message, where it is none of the choices.
double choose(std::string_view word, std::initializer_list<Choice> choices,
              std::string_view parameter, std::string_view known,
              std::vector<Message>& messages) {
  for (const Choice& choice : choices) {
    if (choice.word == word) return choice.place;
  }
  messages.push_back(
      {Severity::kPlain,
       fmt::format("Unknown value for the {} parameter (use {}): '{}'",
                   parameter, known, word)});
  return 0;
}

// The boxes of all glyphs where they stand.
struct Extent {
  Box ink{Vec2(std::numeric_limits<double>::max()),
          Vec2(std::numeric_limits<double>::lowest())};
  // Of the highest and the lowest glyph, each above its own origin.
  double ascent = std::numeric_limits<double>::lowest();
  double descent = std::numeric_limits<double>::max();
  Vec2 advance = Vec2(0);

  bool has_ink() const { return ink.high.x >= ink.low.x; }
};

Extent extent_of(const GlyphRow& row) {
  Extent extent;
  for (const Glyph& glyph : row.glyphs) {
    const Box& box = glyph.box;
    const Vec2 place = extent.advance + glyph.shift;
    extent.advance += glyph.advance;
    if (!(box.high.x > box.low.x && box.high.y > box.low.y)) continue;
    extent.ascent = std::max(extent.ascent, box.high.y);
    extent.descent = std::min(extent.descent, box.low.y);
    extent.ink = {glm::min(extent.ink.low, place + box.low),
                  glm::max(extent.ink.high, place + box.high)};
  }
  return extent;
}

}  // namespace

Vec2 align(const csg::TextParams& params, const GlyphRow& row,
           std::vector<Message>& messages) {
  double width = 0;
  double ascent = 0;
  double descent = 0;
  for (const Glyph& glyph : row.glyphs) {
    const Box& box = glyph.box;
    if (row.is_horizontal) {
      width += glyph.advance.x;
      ascent = std::max(ascent, box.high.y * kShrink);
      descent = std::max(descent, -box.low.y * kShrink);
    } else {
      width = std::max(width, (box.high.x - box.low.x) * kShrink);
      ascent += glyph.advance.y;
    }
  }
  const double x = choose(
      params.halign, {{"left", 0}, {"center", -width / 2}, {"right", -width}},
      "halign", "\"left\", \"right\" or \"center\"", messages);
  const double y = choose(
      params.valign,
      {{"top", -ascent},
       {"center", descent / 2 - ascent / 2},
       {"baseline", 0},
       {"bottom", descent}},
      "valign", "\"baseline\", \"bottom\", \"top\" or \"center\"", messages);
  return {x, y};
}

csg::TextMetrics measure(const csg::TextParams& params, const GlyphRow& row,
                         std::vector<Message>& messages) {
  const Extent extent = extent_of(row);
  csg::TextMetrics metrics;
  metrics.advance = extent.advance * params.size;
  if (!extent.has_ink()) return metrics;
  const Vec2 offset = align(params, row, messages);
  metrics.position = (offset + extent.ink.low) * params.size;
  metrics.size = (extent.ink.high - extent.ink.low) * params.size;
  metrics.ascent = extent.ascent * params.size;
  metrics.descent = extent.descent * params.size;
  metrics.offset = offset * params.size;
  return metrics;
}

csg::FontMetrics measure(double size, const Font& font) {
  const FT_FaceRec& face = *font.face;
  const auto scaled = [&](FT_Long units) {
    return static_cast<double>(FT_MulFix(units, face.size->metrics.y_scale)) /
           Font::kSize * size;
  };
  csg::FontMetrics metrics;
  metrics.nominal_ascent = scaled(face.ascender);
  metrics.nominal_descent = scaled(face.descender);
  metrics.max_ascent = scaled(face.bbox.yMax);
  metrics.max_descent = scaled(face.bbox.yMin);
  metrics.interline = scaled(face.height);
  if (face.family_name) metrics.family = face.family_name;
  if (face.style_name) metrics.style = face.style_name;
  return metrics;
}

}  // namespace lamina::text
