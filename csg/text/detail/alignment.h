#pragma once
// Where a row of glyphs stands, and how large it is: halign, valign, metrics.

#include <vector>

#include "base/vec.h"
#include "csg/text/detail/engine.h"
#include "csg/text/detail/font_cache.h"
#include "csg/text/detail/glyph_row.h"
#include "csg/text_measurer.h"
#include "csg/tree.h"

namespace lamina::text {

// Where text() of OpenSCAD 2021.01 puts the first glyph's origin.
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
