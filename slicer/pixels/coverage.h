#pragma once
// The share of each pixel that a polygon covers, exactly.
//
// Each edge adds the signed area between itself and the pixel's right side to
// every pixel that it crosses; a running sum along the row then gives the
// covered share (the accumulation buffer of stb_truetype and font-rs). No
// samples are drawn, so a share is wrong by rounding only. Edges left of the
// image count in its first column, edges right of it do not count.
//
// Edges touch few pixels of a large image. A bit for each pixel says which
// these are, so that resolving and clearing a row costs what was drawn in it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::slicer {

// Neighbouring pixels of a row that are equally covered.
struct GreyRun {
  std::uint8_t grey = 0;  // 255: wholly covered
  unsigned count = 0;
};

class Coverage {
 public:
  Coverage(unsigned width, unsigned height);

  unsigned width() const { return width_; }
  unsigned height() const { return height_; }

  // Adds a polygon edge, in pixels, y down. Polygons that overlap add up, so
  // strokes that cross must turn the same way.
  void add_edge(Vec2 from, Vec2 to);

  // Adds a line of round ends and joins, `thickness` pixels wide.
  void add_stroke(Vec2 from, Vec2 to, double thickness);

  // Replaces `shares` by the covered shares of the pixels of row y: width() of
  // them, 0 … 1.
  void resolve_row(unsigned y, std::vector<float>& shares) const;

  // Replaces `runs` by those of equal pixels from the left, shares as 0 … 255.
  void resolve_row(unsigned y, std::vector<GreyRun>& runs) const;

  // Takes away all that was added.
  void clear();

 private:
  void add_inside(Vec2 from, Vec2 to);
  void add_in_row(unsigned y, double dy, double x0, double x1);

  // Calls visit(x) for the touched pixels of row y, from the left.
  template <typename Visit>
  void visit_touched(unsigned y, const Visit& visit) const;

  unsigned width_;
  unsigned height_;
  std::size_t row_words_;
  std::vector<double> sums_;            // rows of width_ + 2
  std::vector<std::uint64_t> touched_;  // rows of row_words_: bits of sums_
};

// Maps millimetres to the pixels of an image, whose y runs down.
struct PixelMap {
  Vec2 origin = Vec2(0);     // where (0, 0) mm is [pixels]
  Vec2 per_x = Vec2(1, 0);   // pixels per mm of x
  Vec2 per_y = Vec2(0, -1);  // and of y

  Vec2 operator()(Vec2 mm) const {
    return origin + mm.x * per_x + mm.y * per_y;
  }
};

void add_loop(Coverage& coverage, std::span<const Vec2> loop,
              const PixelMap& map);

void add_contours(Coverage& coverage, const plane::Contours& contours,
                  const PixelMap& map);

}  // namespace lamina::slicer
