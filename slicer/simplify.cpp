#include "slicer/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lamina::slicer {
namespace {

// Rectangles are widened by this [mm], so that rounding cannot hide a vertex
// that lies on their rim: the kinetic ray merges what is nearer.
constexpr double kRimWidth = 1e-9;

// Shortest run that is always tried; longer ones at most double from run to
// run, so that runs that fail cost no more than those that succeed.
constexpr std::uint32_t kFirstRun = 16;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }

// Twice the area over the perimeter (measured along the axes, hence at most
// √2 too long): how thick a loop is where it is long.
double thickness(std::span<const Vec2> closed_loop) {
  double doubled_area = 0;
  double length = 0;
  const Vec2 origin = closed_loop.front();
  for (std::size_t i = 1; i < closed_loop.size(); ++i) {
    const Vec2 a = closed_loop[i - 1] - origin;
    const Vec2 b = closed_loop[i] - origin;
    doubled_area += cross(a, b);
    length += std::abs(b.x - a.x) + std::abs(b.y - a.y);
  }
  return length > 0 ? std::abs(doubled_area) / length : 0;
}

std::uint32_t cell_index(double cell, std::uint32_t count) {
  return static_cast<std::uint32_t>(
      std::clamp(cell, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

void Simplifier::simplify(ldni::Contours& contours) {
  if (!(tolerance_ > 0) || contours.is_empty()) return;
  // Copy the loops, each from its leftmost point and closed.
  points_.clear();
  loop_ends_.clear();
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    const auto first = std::min_element(
        loop.begin(), loop.end(), [](const Vec2& a, const Vec2& b) {
          return a.x < b.x || (a.x == b.x && a.y < b.y);
        });
    points_.insert(points_.end(), first, loop.end());
    points_.insert(points_.end(), loop.begin(), first + 1);
    loop_ends_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
  has_cells_ = false;
  result_.clear();
  std::uint32_t begin = 0;
  for (const std::uint32_t end : loop_ends_) {
    simplify_loop(begin, end - 1);
    begin = end;
  }
  std::swap(contours, result_);
}

void Simplifier::fill_cells() {
  has_cells_ = true;
  Vec2 low = points_.front();
  Vec2 high = low;
  for (const Vec2& p : points_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // Choose cells: about four a vertex, of equal width and height.
  const Vec2 size = high - low;
  const double wanted = 4.0 * static_cast<double>(points_.size());
  const double longest = std::max({size.x, size.y, kRimWidth});
  cells_.x0 = low.x;
  cells_.y0 = low.y;
  cells_.cells_per_mm = std::min(
      std::sqrt(wanted / std::max(size.x * size.y, 1e-300)), wanted / longest);
  cells_.columns = 1 + static_cast<std::uint32_t>(size.x * cells_.cells_per_mm);
  cells_.rows = 1 + static_cast<std::uint32_t>(size.y * cells_.cells_per_mm);
  cells_.last.assign(std::size_t{cells_.columns} * cells_.rows, kNone);

  run_begin_.resize(points_.size());
  previous_run_.resize(points_.size());
  std::uint32_t begin = 0;
  for (const std::uint32_t end : loop_ends_) {
    for (std::uint32_t i = begin; i + 1 < end; ++i) {
      const Vec2 at = (points_[i] - low) * cells_.cells_per_mm;
      std::uint32_t& last =
          cells_.last[std::size_t{static_cast<std::uint32_t>(at.y)} *
                          cells_.columns +
                      static_cast<std::uint32_t>(at.x)];
      if (i > begin && last == i - 1) {
        run_begin_[i] = run_begin_[i - 1];
      } else {
        run_begin_[i] = i;
        previous_run_[i] = last;
      }
      last = i;
    }
    begin = end;
  }
}

// begin … end: the loop's vertices, the last a copy of the first.
void Simplifier::simplify_loop(std::uint32_t begin, std::uint32_t end) {
  const double tolerance = std::min(
      tolerance_, thickness({points_.data() + begin, end - begin + 1U}) / 4);
  std::uint32_t longest = kFirstRun;
  for (std::uint32_t anchor = begin; anchor != end;) {
    result_.points.push_back(points_[anchor]);
    std::uint32_t last =
        longest_run(anchor, std::min(end, anchor + longest), tolerance);
    while (last > anchor + 1 && !is_safe(anchor, last, tolerance)) {
      last = anchor + (last - anchor) / 2;
    }
    longest = std::max(kFirstRun, 2 * (last - anchor));
    anchor = last;
  }
  result_.ends.push_back(static_cast<std::uint32_t>(result_.points.size()));
}

// Last vertex, at most `end`, for which a straight line from the anchor passes
// all vertices between within the tolerance (by the cone alone).
std::uint32_t Simplifier::longest_run(std::uint32_t anchor, std::uint32_t end,
                                      double tolerance) const {
  if (end < anchor + 2) return end;
  // Most runs of a coarse section end at once; that is cheap to see.
  const Vec2 first = points_[anchor + 1] - points_[anchor];
  const Vec2 second = points_[anchor + 2] - points_[anchor];
  const double area = cross(first, second);
  if (area * area > tolerance * tolerance * dot(second, second)) {
    return anchor + 1;
  }
  Vec2 right{0, 0};  // of the cone; no cone yet while it is 0
  Vec2 left{0, 0};
  double farthest = 0;
  for (std::uint32_t i = anchor + 1; i <= end; ++i) {
    const Vec2 to = points_[i] - points_[anchor];
    if (cross(right, to) < 0 || cross(to, left) < 0) return i - 1;
    const double distance = std::sqrt(dot(to, to));
    if (distance < farthest - tolerance) return i - 1;  // it turns back
    farthest = std::max(farthest, distance);
    if (distance <= tolerance) continue;
    // Narrow the cone to the lines that pass this vertex near enough. The
    // chord is a little narrower than the tangents: on the safe side.
    const Vec2 aside = left_of(to) * (tolerance / distance);
    const bool is_first = right.x == 0 && right.y == 0;
    if (is_first || cross(right, to - aside) > 0) right = to - aside;
    if (is_first || cross(to + aside, left) > 0) left = to + aside;
  }
  return end;
}

bool Simplifier::is_safe(std::uint32_t anchor, std::uint32_t last,
                         double tolerance) {
  const Vec2 shortcut = points_[last] - points_[anchor];
  const double length = std::sqrt(dot(shortcut, shortcut));
  if (length == 0) return false;
  const Vec2 along = shortcut / length;
  double lowest = 0;
  double highest = 0;
  for (std::uint32_t i = anchor + 1; i < last; ++i) {
    const Vec2 to = points_[i] - points_[anchor];
    const double abscissa = dot(along, to);
    if (abscissa < 0 || abscissa > length) return false;
    const double deviation = cross(along, to);
    lowest = std::min(lowest, deviation);
    highest = std::max(highest, deviation);
  }
  if (highest > tolerance || -lowest > tolerance) return false;
  if (!has_cells_) fill_cells();
  return !has_foreign_vertex(anchor, last, along, length, lowest, highest);
}

bool Simplifier::has_foreign_vertex(std::uint32_t anchor, std::uint32_t last,
                                    Vec2 along, double length, double lowest,
                                    double highest) const {
  const Vec2 a = points_[anchor];
  const Vec2 b = points_[last];
  const auto lies_in_rectangle = [&](std::uint32_t i) {
    const Vec2 to = points_[i] - a;
    const double abscissa = dot(along, to);
    const double deviation = cross(along, to);
    return abscissa >= -kRimWidth && abscissa <= length + kRimWidth &&
           deviation >= lowest - kRimWidth && deviation <= highest + kRimWidth;
  };
  // A loop's first vertex ends its last run too, as a copy.
  const auto is_own_copy = [&](std::uint32_t i) {
    return points_[i] == b || points_[i] == a;
  };
  const auto has_foreign_in = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t i = from; i < to; ++i) {
      if (lies_in_rectangle(i) && !is_own_copy(i)) return true;
    }
    return false;
  };
  const auto has_foreign_in_cell = [&](std::uint32_t newest) {
    for (std::uint32_t end = newest; end != kNone;) {
      const std::uint32_t begin = run_begin_[end];
      if (has_foreign_in(begin, std::min(end + 1, anchor)) ||
          has_foreign_in(std::max(begin, last + 1), end + 1)) {
        return true;
      }
      end = previous_run_[begin];
    }
    return false;
  };

  // Walk the cells row by row; a point of R is at most `reach` from the
  // shortcut in x and in y.
  const double reach = std::max(highest, -lowest) + kRimWidth;
  const double scale = cells_.cells_per_mm;
  const auto row_of = [&](double y) {
    return cell_index((y - cells_.y0) * scale, cells_.rows);
  };
  const auto column_of = [&](double x) {
    return cell_index((x - cells_.x0) * scale, cells_.columns);
  };
  const Vec2 lower = a.y <= b.y ? a : b;
  const Vec2 upper = a.y <= b.y ? b : a;
  const double slope =
      upper.y > lower.y ? (upper.x - lower.x) / (upper.y - lower.y) : 0;
  const std::uint32_t first_row = row_of(lower.y - reach);
  const std::uint32_t last_row = row_of(upper.y + reach);
  for (std::uint32_t row = first_row; row <= last_row; ++row) {
    double x0 = lower.x;
    double x1 = upper.x;
    if (first_row != last_row && upper.y > lower.y) {
      const double row_low = cells_.y0 + row / scale - reach;
      const double row_high = cells_.y0 + (row + 1) / scale + reach;
      x0 += slope * (std::clamp(row_low, lower.y, upper.y) - lower.y);
      x1 = lower.x + slope * (std::clamp(row_high, lower.y, upper.y) - lower.y);
    }
    const std::uint32_t last_column = column_of(std::max(x0, x1) + reach);
    for (std::uint32_t column = column_of(std::min(x0, x1) - reach);
         column <= last_column; ++column) {
      if (has_foreign_in_cell(
              cells_.last[std::size_t{row} * cells_.columns + column])) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace lamina::slicer
