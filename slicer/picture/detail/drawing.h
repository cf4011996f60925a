#pragma once
// What flat pictures of layers consist of: boxes, lettering, the layer itself.

#include <string_view>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer.h"
#include "slicer/picture/image.h"
#include "slicer/pixels/coverage.h"

namespace lamina::slicer {

// Adds a line of text, in UTF-8, in an alphabet of strokes of our own, so that
// pictures look the same everywhere and need no font. It knows ASCII letters,
// digits and . , : - _ / ( ) + = % × ² ³; other characters become a small box.
//
// at    left end of the base line [pixels]
// size  height of a capital [pixels]
void add_text(Coverage& coverage, std::string_view text, Vec2 at, double size);

// Width of the line [pixels].
double text_width(std::string_view text, double size);

// Around tiles and the whole [pixels].
inline constexpr unsigned kMargin = 18;
// Heights of capitals [pixels].
inline constexpr double kTitleSize = 17;
inline constexpr double kTextSize = 12;

inline constexpr Rgb kPaper = {0.97F, 0.965F, 0.95F};
inline constexpr Rgb kTile = {1.0F, 1.0F, 0.995F};
inline constexpr Rgb kFrame = {0.86F, 0.85F, 0.82F};
inline constexpr Rgb kInk = {0.25F, 0.24F, 0.22F};

// The box around all layers [mm].
Box2 bounds_of(const std::vector<Layer>& layers);

// A field of pixels, y down.
struct Rectangle {
  unsigned x = 0;
  unsigned y = 0;
  unsigned width = 0;
  unsigned height = 0;
};

void fill(Image& image, const Rectangle& area, Rgb color);

// Draws a white field with a thin frame around it.
void draw_tile(Image& image, const Rectangle& area);

// Mixes `color` into the image by the shares of `coverage`, its corner at (x,
// y).
void blend(Image& image, const Coverage& coverage, unsigned x, unsigned y,
           Rgb color);

// Draws a line of text whose base line begins at `at`.
//
// size  height of a capital [pixels]
void draw_text(Image& image, std::string_view text, Vec2 at, double size,
               Rgb color = kInk);

// Returns the largest size, `size` at most, at which the text is no wider than
// `room`; 0 where no size is.
double fitting_size(std::string_view text, double size, double room);

// Maps millimetres to pixels, counted from the area's corner, so that the
// bounds fill the area but for `padding` pixels on every side.
PixelMap fit(const Box2& bounds, const Rectangle& area, double padding);

// Returns the largest of 1, 2, 5, 10, … (and 0.5, 0.2, …) that is no longer.
double round_length(double longest);

// Draws a bar of a round length, `longest` pixels at most, with its length
// beside it.
//
// at       its left end [pixels]
// size     of a capital [pixels]
// returns  where the words end [pixels]
double draw_scale(Image& image, Vec2 at, double longest, double pixels_per_mm,
                  double size);

// Draws the layer, filled and with an outline, its supports in a colour of
// their own.
//
// map            from the area's corner
// outline_width  [pixels]
void draw_layer(Image& image, const Layer& layer, const Rectangle& area,
                const PixelMap& map, double outline_width);

}  // namespace lamina::slicer
