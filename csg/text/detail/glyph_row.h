#pragma once
// A text as a row of glyphs: shaped by HarfBuzz, loaded by FreeType.

#include <vector>

#include "base/vec.h"
#include "csg/text/detail/engine.h"
#include "csg/text/detail/font_cache.h"
#include "csg/tree.h"

namespace lamina::text {

struct Box {
  Vec2 low = Vec2(0);
  Vec2 high = Vec2(0);
};

using OwnedGlyph = Owned<FT_GlyphRec_>;

// Lengths are in units of text(size = 1).
struct Glyph {
  OwnedGlyph outline;
  Box box;       // of the outline and its control points
  Vec2 shift;    // of the outline from where it would stand
  Vec2 advance;  // to the next glyph, spacing included
};

struct GlyphRow {
  std::vector<Glyph> glyphs;
  bool is_horizontal = true;
};

// OpenSCAD 2021.01 sets glyphs, and takes the heights of rows, 2.4% smaller
// than the outlines are. Later releases no longer do this.
constexpr double kShrink = 1 / 1.024;

// messages  gets glyphs that cannot be loaded
GlyphRow shape(const csg::TextParams& params, const Font& font,
               std::vector<Message>& messages);

}  // namespace lamina::text
