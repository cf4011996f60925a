#include "slicer/pixels/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace lamina::slicer {
namespace {

// A stroke ends in half circles of this many edges.
constexpr int kRoundCorners = 6;

constexpr unsigned kWordBits = 64;

}  // namespace

Coverage::Coverage(unsigned width, unsigned height)
    : width_(width),
      height_(height),
      row_words_((std::size_t{width} + 2 + kWordBits - 1) / kWordBits),
      sums_(std::size_t{width + 2} * height, 0.0),
      touched_(row_words_ * height, 0) {}

void Coverage::add_edge(Vec2 from, Vec2 to) {
  if (std::max(from.y, to.y) <= 0 || std::min(from.y, to.y) >= height_) return;
  // Cut the edge at the image's left and right side, and move what lies outside
  // onto the side.
  const auto clamped = [this](Vec2 p) {
    return Vec2(std::clamp(p.x, 0.0, static_cast<double>(width_)), p.y);
  };
  double cuts[4] = {0, 1, 1, 1};
  int count = 1;
  const double dx = to.x - from.x;
  if (dx != 0) {
    const double left = (0 - from.x) / dx;
    const double right = (width_ - from.x) / dx;
    for (const double cut : {std::min(left, right), std::max(left, right)}) {
      if (cut > 0 && cut < 1) cuts[count++] = cut;
    }
  }
  cuts[count] = 1;
  Vec2 begin = from;
  for (int i = 1; i <= count; ++i) {
    const Vec2 end = i == count ? to : from + cuts[i] * (to - from);
    add_inside(clamped(begin), clamped(end));
    begin = end;
  }
}

void Coverage::add_inside(Vec2 from, Vec2 to) {
  if (from.y == to.y) return;
  const double direction = from.y < to.y ? 1 : -1;
  const Vec2 upper = from.y < to.y ? from : to;
  const Vec2 lower = from.y < to.y ? to : from;
  const double slope = (lower.x - upper.x) / (lower.y - upper.y);
  const double y_begin = std::max(upper.y, 0.0);
  const double y_end = std::min(lower.y, static_cast<double>(height_));
  if (y_begin >= y_end) return;
  const auto first = static_cast<unsigned>(y_begin);
  const auto last = static_cast<unsigned>(std::ceil(y_end));
  for (unsigned y = first; y < last; ++y) {
    const double top = std::max(y_begin, static_cast<double>(y));
    const double bottom = std::min(y_end, y + 1.0);
    if (bottom <= top) continue;
    const auto x_at = [&](double at) {
      return std::clamp(upper.x + slope * (at - upper.y), 0.0,
                        static_cast<double>(width_));
    };
    add_in_row(y, direction * (bottom - top), x_at(top), x_at(bottom));
  }
}

// Adds an edge within a row, dy rows high (signed), from x0 to x1.
void Coverage::add_in_row(unsigned y, double dy, double x0, double x1) {
  double* const row = sums_.data() + std::size_t{y} * (width_ + 2);
  std::uint64_t* const touched = touched_.data() + y * row_words_;
  const auto touch = [&](std::size_t column) {
    touched[column / kWordBits] |= std::uint64_t{1} << column % kWordBits;
  };
  const double left = std::min(x0, x1);
  const double right = std::max(x0, x1);
  const auto first = static_cast<std::size_t>(left);
  const auto last = static_cast<std::size_t>(right);
  if (first == last) {
    const double middle = (left + right) / 2 - static_cast<double>(first);
    row[first] += dy * (1 - middle);
    row[first + 1] += dy * middle;
    touch(first);
    touch(first + 1);
    return;
  }
  // Each column gets the part of dy that falls into it.
  const double dy_per_column = dy / (right - left);
  for (std::size_t column = first; column <= last; ++column) {
    const auto begin = static_cast<double>(column);
    const double part_begin = std::max(left, begin);
    const double part_end = std::min(right, begin + 1);
    const double part = dy_per_column * (part_end - part_begin);
    const double middle = (part_begin + part_end) / 2 - begin;
    row[column] += part * (1 - middle);
    row[column + 1] += part * middle;
    touch(column);
  }
  touch(last + 1);
}

template <typename Visit>
void Coverage::visit_touched(unsigned y, const Visit& visit) const {
  const std::uint64_t* const touched = touched_.data() + y * row_words_;
  for (std::size_t i = 0; i < row_words_; ++i) {
    for (std::uint64_t bits = touched[i]; bits != 0; bits &= bits - 1) {
      visit(static_cast<unsigned>(i * kWordBits) +
            static_cast<unsigned>(std::countr_zero(bits)));
    }
  }
}

void Coverage::add_stroke(Vec2 from, Vec2 to, double thickness) {
  // Go around the stroke, always in the same sense.
  const Vec2 step = to - from;
  const double start = std::atan2(step.y, step.x) + std::numbers::pi / 2;
  Vec2 corners[2 * (kRoundCorners + 1)];
  int count = 0;
  for (const Vec2 end : {from, to}) {
    const double turn = count == 0 ? start : start + std::numbers::pi;
    for (int i = 0; i <= kRoundCorners; ++i) {
      const double angle = turn + std::numbers::pi * i / kRoundCorners;
      corners[count++] =
          end + thickness / 2 * Vec2(std::cos(angle), std::sin(angle));
    }
  }
  for (int i = 0; i < count; ++i) {
    add_edge(corners[i], corners[(i + 1) % count]);
  }
}

void Coverage::resolve_row(unsigned y, std::vector<float>& shares) const {
  shares.resize(width_);
  const double* row = sums_.data() + std::size_t{y} * (width_ + 2);
  double sum = 0;
  for (unsigned x = 0; x < width_; ++x) {
    sum += row[x];
    shares[x] = static_cast<float>(std::min(std::abs(sum), 1.0));
  }
}

void Coverage::resolve_row(unsigned y, std::vector<GreyRun>& runs) const {
  runs.clear();
  const double* row = sums_.data() + std::size_t{y} * (width_ + 2);
  double sum = 0;
  std::uint8_t grey = 0;
  unsigned begin = 0;  // of the run that goes on
  // The share changes only where an edge passes.
  visit_touched(y, [&](unsigned x) {
    if (x >= width_) return;
    sum += row[x];
    const double share = std::min(std::abs(sum), 1.0);
    // Never negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
    const auto now = static_cast<std::uint8_t>(255 * share + 0.5);
    if (now == grey) return;
    if (x > begin) runs.push_back({grey, x - begin});
    grey = now;
    begin = x;
  });
  if (width_ > begin) runs.push_back({grey, width_ - begin});
}

void Coverage::clear() {
  for (unsigned y = 0; y < height_; ++y) {
    double* const row = sums_.data() + std::size_t{y} * (width_ + 2);
    visit_touched(y, [&](unsigned x) { row[x] = 0; });
  }
  std::ranges::fill(touched_, 0);
}

void add_loop(Coverage& coverage, std::span<const Vec2> loop,
              const PixelMap& map) {
  if (loop.empty()) return;
  Vec2 previous = map(loop.back());
  for (const Vec2& point : loop) {
    const Vec2 current = map(point);
    coverage.add_edge(previous, current);
    previous = current;
  }
}

void add_contours(Coverage& coverage, const plane::Contours& contours,
                  const PixelMap& map) {
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    add_loop(coverage, contours.loop(i), map);
  }
}

}  // namespace lamina::slicer
