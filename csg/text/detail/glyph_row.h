#pragma once
// A text as a row of glyphs: shaped by HarfBuzz, loaded by FreeType; where the
// row stands, and how large it is.

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "csg/text/detail/engine.h"
#include "csg/text/detail/font_cache.h"
#include "csg/text_measurer.h"
#include "csg/tree.h"

namespace lamina::text {

struct Box {
  Vec2 low = Vec2(0);
  Vec2 high = Vec2(0);
};

using OwnedGlyph = Owned<FT_GlyphRec_>;

struct Letter {
  hb_codepoint_t code = 0;
  std::uint32_t at = 0;  // in the bytes of the text
};

// Lengths are in units of text(size = 1).
struct Glyph {
  OwnedGlyph outline;
  Box box;       // of the outline and its control points
  Vec2 shift;    // of the outline from where it would stand
  Vec2 advance;  // to the next glyph, spacing included
};

struct GlyphRow {
  std::vector<Glyph> glyphs;
  std::vector<Letter> letters;  // of the text
  std::vector<Letter> missing;  // those that the font cannot draw, each once
  bool is_horizontal = true;
};

// OpenSCAD 2021.01 sets glyphs, and takes the heights of rows, 2.4% smaller
// than the outlines are. Later releases no longer do this.
inline double shrink(Language rules) {
  return rules == Language::k2021 ? 1 / 1.024 : 1;
}

// messages  gets glyphs that cannot be loaded
GlyphRow shape(const csg::TextParams& params, const Font& font,
               std::vector<Message>& messages);

// Where text() puts the first glyph's origin: halign and valign. 2021.01 goes
// by the glyphs' advances and by the heights above and below the baseline,
// later releases by what is drawn, and in columns otherwise than in rows.
//
// messages  gets unknown alignments
Vec2 align(const csg::TextParams& params, const GlyphRow& row,
           std::vector<Message>& messages);

// textmetrics(): the measures of what text() draws.
csg::TextMetrics measure(const csg::TextParams& params, const GlyphRow& row,
                         std::vector<Message>& messages);

// fontmetrics() at a size.
csg::FontMetrics measure(double size, const Font& font);

}  // namespace lamina::text
