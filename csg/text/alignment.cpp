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
              Language rules, std::vector<Message>& messages) {
  for (const Choice& choice : choices) {
    if (choice.word == word) return choice.place;
  }
  messages.push_back(
      {rules == Language::k2021 ? Severity::kPlain : Severity::kWarning,
       fmt::format("Unknown value for the {} parameter (use {}): '{}'",
                   parameter, known, word)});
  return 0;
}

// The boxes of all glyphs where they stand.
struct Extent {
  Box ink{Vec2(std::numeric_limits<double>::max()),
          Vec2(std::numeric_limits<double>::lowest())};
  // The highest and the lowest glyph, each above its own origin.
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

Vec2 place(const csg::TextParams& params,
           std::initializer_list<Choice> horizontal,
           std::initializer_list<Choice> vertical,
           std::vector<Message>& messages) {
  const double x =
      choose(params.halign, horizontal, "halign",
             "\"left\", \"right\" or \"center\"", params.rules, messages);
  const double y = choose(params.valign, vertical, "valign",
                          "\"baseline\", \"bottom\", \"top\" or \"center\"",
                          params.rules, messages);
  return {x, y};
}

Vec2 align_as_2021(const csg::TextParams& params, const GlyphRow& row,
                   std::vector<Message>& messages) {
  const double shrunk = shrink(Language::k2021);
  double width = 0;
  double ascent = 0;
  double descent = 0;
  for (const Glyph& glyph : row.glyphs) {
    const Box& box = glyph.box;
    if (row.is_horizontal) {
      width += glyph.advance.x;
      ascent = std::max(ascent, box.high.y * shrunk);
      descent = std::max(descent, -box.low.y * shrunk);
    } else {
      width = std::max(width, (box.high.x - box.low.x) * shrunk);
      ascent += glyph.advance.y;
    }
  }
  return place(
      params,
      {{"left", 0}, {"default", 0}, {"center", -width / 2}, {"right", -width}},
      {{"top", -ascent},
       {"center", descent / 2 - ascent / 2},
       {"baseline", 0},
       {"default", 0},
       {"bottom", descent}},
      messages);
}

Vec2 align_row(const csg::TextParams& params, const Extent& extent,
               std::vector<Message>& messages) {
  return place(params,
               {{"left", 0},
                {"default", 0},
                {"center", -extent.advance.x / 2},
                {"right", -extent.advance.x}},
               {{"top", -extent.ascent},
                {"center", -(extent.ascent + extent.descent) / 2},
                {"baseline", 0},
                {"default", 0},
                {"bottom", -extent.descent}},
               messages);
}

Vec2 align_column(const csg::TextParams& params, const Extent& extent,
                  std::vector<Message>& messages) {
  if (params.valign == "baseline") {
    messages.push_back({Severity::kWarning,
                        "Don't use valign=\"baseline\" with vertical layouts"});
  }
  return place(params,
               {{"left", -extent.ink.low.x},
                {"default", 0},
                {"center", 0},
                {"right", -extent.ink.high.x}},
               {{"top", 0},
                {"default", 0},
                {"baseline", 0},
                {"center", -extent.advance.y / 2},
                {"bottom", -extent.advance.y}},
               messages);
}

}  // namespace

Vec2 align(const csg::TextParams& params, const GlyphRow& row,
           std::vector<Message>& messages) {
  if (params.rules == Language::k2021) {
    return align_as_2021(params, row, messages);
  }
  const Extent extent = extent_of(row);
  if (!extent.has_ink()) return Vec2(0);
  return row.is_horizontal ? align_row(params, extent, messages)
                           : align_column(params, extent, messages);
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
  const FT_FaceRec& face = *font.face->outlines;
  const auto scaled = [&](FT_Long units) {
    return static_cast<double>(FT_MulFix(units, face.size->metrics.y_scale)) /
           Face::kSize * size;
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
