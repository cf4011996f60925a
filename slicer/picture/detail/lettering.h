#pragma once
// Lettering for pictures: an alphabet of strokes of our own, so that pictures
// look the same everywhere and need no font.

#include <string_view>

#include "slicer/formats/coverage.h"

namespace lamina::slicer {

// Adds a line of text, in UTF-8. It knows ASCII letters, digits and
// . , : - _ / ( ) + = % × ² ³; other characters become a small box.
//
// at    left end of the base line [pixels]
// size  height of a capital [pixels]
void add_text(Coverage& coverage, std::string_view text, Vec2 at, double size);

// Width of the line [pixels].
double text_width(std::string_view text, double size);

}  // namespace lamina::slicer
