#pragma once
// A text as a row of glyphs: shaped by HarfBuzz, loaded by FreeType.

#include <memory>
#include <vector>

#include <ft2build.h>
#include <hb.h>

#include "csg/text/detail/engine.h"
#include "csg/text/detail/font_cache.h"
#include "csg/tree.h"
#include "csg/vec.h"
#include FT_GLYPH_H

namespace lamina::text {

struct ReleaseGlyph {
  void operator()(FT_Glyph glyph) const { FT_Done_Glyph(glyph); }
};
using OwnedGlyph = std::unique_ptr<FT_GlyphRec_, ReleaseGlyph>;

// Lengths are those of text(size = 1).
struct Glyph {
  OwnedGlyph outline;
  FT_BBox box;   // of the outline and its control points [1/64 pixel]
  Vec2 shift;    // of the outline from where it would stand
  Vec2 advance;  // to the next glyph, spacing included
};

struct GlyphRow {
  std::vector<Glyph> glyphs;
  bool is_horizontal = true;
};

// OpenSCAD 2021.01 scales what HarfBuzz says about distances 2.4% smaller than
// the outlines themselves, and so it is here.
constexpr double kUnscale = 1 / 1.024e5;

// messages  gets glyphs that cannot be loaded
GlyphRow shape(const csg::TextParams& params, const Font& font,
               std::vector<Message>& messages);

// Where the first glyph's origin stands, by halign and valign.
//
// messages  gets alignments that are none
Vec2 align(const csg::TextParams& params, const GlyphRow& row,
           std::vector<Message>& messages);

}  // namespace lamina::text
