#include "slicer/pixels/detail/pixel_contours.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <vector>

namespace lamina::slicer {
namespace {

constexpr double kHalf = 127.5;

// A side of a square between four middles: that to the right of a middle, or
// that below it.
using Side = std::uint64_t;

// Where a contour leaves a square to the next one.
struct Step {
  Side next = 0;
  Vec2 from = Vec2(0);  // where the contour crosses the side that it came by
};

class Stitcher {
 public:
  Stitcher(std::span<const std::uint8_t> pixels, std::size_t columns,
           std::size_t rows)
      : pixels_(pixels), columns_(columns), rows_(rows) {}

  plane::Contours trace() {
    for (std::size_t row = 0; row <= rows_; ++row) {
      if (is_empty(row) && (row == 0 || is_empty(row - 1))) continue;
      for (std::size_t column = 0; column <= columns_; ++column) {
        take_square(column, row);
      }
    }
    return link();
  }

 private:
  // The grey of pixel (column - 1, row - 1); beyond the image it is black.
  double grey(std::size_t column, std::size_t row) const {
    if (column == 0 || row == 0 || column > columns_ || row > rows_) return 0;
    return pixels_[(row - 1) * columns_ + column - 1];
  }
  // Whether all pixels of a row, counted from 0, are black.
  bool is_empty(std::size_t row) const {
    if (row >= rows_) return true;
    const auto line = pixels_.subspan(row * columns_, columns_);
    return std::ranges::all_of(line, [](std::uint8_t g) { return g == 0; });
  }
  Side side(std::size_t column, std::size_t row, bool is_below) const {
    return 2 * (std::uint64_t{row} * (columns_ + 2) + column) +
           (is_below ? 1 : 0);
  }

  // The square whose upper left middle is grey(column, row).
  void take_square(std::size_t column, std::size_t row) {
    const double upper_left = grey(column, row);
    const double upper_right = grey(column + 1, row);
    const double lower_left = grey(column, row + 1);
    const double lower_right = grey(column + 1, row + 1);
    const unsigned kind =
        (upper_left > kHalf ? 1U : 0U) | (upper_right > kHalf ? 2U : 0U) |
        (lower_right > kHalf ? 4U : 0U) | (lower_left > kHalf ? 8U : 0U);
    if (kind == 0 || kind == 15) return;
    const Vec2 middle(static_cast<double>(column) - 0.5,
                      static_cast<double>(row) - 0.5);
    const auto share = [](double a, double b) { return (kHalf - a) / (b - a); };
    // Top, right, bottom, left.
    const std::array<Side, 4> sides = {
        side(column, row, false), side(column + 1, row, true),
        side(column, row + 1, false), side(column, row, true)};
    const auto place = [&](std::size_t i) {
      switch (i) {
        case 0:
          return middle + Vec2(share(upper_left, upper_right), 0);
        case 1:
          return middle + Vec2(1, share(upper_right, lower_right));
        case 2:
          return middle + Vec2(share(lower_left, lower_right), 1);
        default:
          return middle + Vec2(0, share(upper_left, lower_left));
      }
    };
    const auto add = [&](std::size_t to, std::size_t from) {
      steps_[sides[from]] = {sides[to], place(from)};
    };
    const bool joins =
        upper_left + upper_right + lower_left + lower_right > 4 * kHalf;
    // White lies to the left as seen with y upwards. By kind: two opposite
    // corners, 5 and 10, have two steps.
    struct Sides {
      std::size_t to;
      std::size_t from;
    };
    constexpr std::array<Sides, 15> kSteps = {{{0, 0},
                                               {0, 3},
                                               {1, 0},
                                               {1, 3},
                                               {2, 1},
                                               {0, 0},
                                               {2, 0},
                                               {2, 3},
                                               {3, 2},
                                               {0, 2},
                                               {0, 0},
                                               {1, 2},
                                               {3, 1},
                                               {0, 1},
                                               {3, 0}}};
    if (kind == 5) {
      add(0, joins ? 1 : 3);
      add(2, joins ? 3 : 1);
    } else if (kind == 10) {
      add(1, joins ? 2 : 0);
      add(3, joins ? 0 : 2);
    } else {
      add(kSteps[kind].to, kSteps[kind].from);
    }
  }

  plane::Contours link() {
    plane::Contours contours;
    std::vector<Side> begins;
    begins.reserve(steps_.size());
    for (const auto& [begin, step] : steps_) begins.push_back(begin);
    std::ranges::sort(begins);
    std::vector<Vec2> loop;
    for (const Side begin : begins) {
      loop.clear();
      for (auto at = steps_.find(begin); at != steps_.end();) {
        loop.push_back(at->second.from);
        const Side next = at->second.next;
        steps_.erase(at);
        at = steps_.find(next);
      }
      if (loop.size() >= 3) contours.add_loop(loop);
    }
    return contours;
  }

  const std::span<const std::uint8_t> pixels_;
  const std::size_t columns_;
  const std::size_t rows_;
  std::unordered_map<Side, Step> steps_;
};

}  // namespace

plane::Contours trace_pixels(std::span<const std::uint8_t> pixels,
                             std::size_t columns, std::size_t rows) {
  return Stitcher(pixels, columns, rows).trace();
}

}  // namespace lamina::slicer
