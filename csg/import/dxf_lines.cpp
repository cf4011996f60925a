#include "csg/import/detail/dxf_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace lamina::csg {
namespace {

constexpr double kStep = 0x1p-10;  // mm

// Whether OpenSCAD reverses the closed path, so that all run the same way. The
// directions at its leftmost point decide.
bool would_turn(const std::vector<Vec2>& points) {
  const auto leftmost = std::min_element(
      points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
  const auto b = static_cast<std::size_t>(leftmost - points.begin());
  const Vec2 before = points[b == 0 ? points.size() - 2 : b - 1] - *leftmost;
  const Vec2 behind = points[b == points.size() - 1 ? 1 : b + 1] - *leftmost;
  return std::atan2(before.x, before.y) < std::atan2(behind.x, behind.y);
}

class Joiner {
 public:
  Joiner(const std::vector<DxfLine>& lines, const DxfGrid& grid)
      : lines_(lines),
        grid_(grid),
        is_taken_(lines.size()),
        ends_(grid.size()) {}

  std::vector<DxfPath> join() {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const auto [a, b] = lines_[i];
      add_end(a, i);
      if (a != b) add_end(b, i);
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) watch(i);
    std::vector<DxfPath> paths;
    while (!open_.empty()) {
      const std::size_t line = *open_.begin();
      paths.push_back({walk(line, is_open_end(lines_[line][0]) ? 0 : 1)});
    }
    const bool has_open = !paths.empty();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (is_taken_[i]) continue;
      DxfPath path{walk(i, 0), true};
      // One end goes, the other one closes the path: it is the same point,
      // unless the path ran into a dead end.
      const bool is_turned = !has_open && would_turn(path.points);
      path.points.erase(is_turned ? path.points.end() - 1
                                  : path.points.begin());
      paths.push_back(std::move(path));
    }
    return paths;
  }

 private:
  // Lines that end in a point.
  struct End {
    std::vector<std::size_t> lines;
    std::size_t first = 0;  // those before it are taken
    std::size_t left = 0;   // that are not taken
  };

  void add_end(std::uint32_t point, std::size_t line) {
    ends_[point].lines.push_back(line);
    ++ends_[point].left;
  }

  bool is_open_end(std::uint32_t point) const { return ends_[point].left == 1; }

  void watch(std::size_t line) {
    const auto [a, b] = lines_[line];
    if (is_open_end(a) || is_open_end(b)) open_.insert(line);
  }

  // The first line in the point that is not taken.
  std::optional<std::size_t> next(std::uint32_t point) {
    End& end = ends_[point];
    if (end.left == 0) return std::nullopt;
    while (is_taken_[end.lines[end.first]]) ++end.first;
    return end.lines[end.first];
  }

  void take(std::size_t line) {
    is_taken_[line] = true;
    open_.erase(line);
    const auto [a, b] = lines_[line];
    leave(a);
    if (a != b) leave(b);
  }

  void leave(std::uint32_t point) {
    --ends_[point].left;
    if (ends_[point].left == 1) watch(*next(point));
  }

  // Takes lines until none goes on.
  std::vector<Vec2> walk(std::size_t line, std::size_t from) {
    std::vector<Vec2> points = {grid_[lines_[line][from]]};
    for (std::optional<std::size_t> at = line; at;) {
      const std::uint32_t to = lines_[*at][1 - from];
      points.push_back(grid_[to]);
      take(*at);
      at = next(to);
      if (at) from = lines_[*at][0] == to ? 0 : 1;
    }
    return points;
  }

  const std::vector<DxfLine>& lines_;
  const DxfGrid& grid_;
  std::vector<bool> is_taken_;
  std::vector<End> ends_;       // by point
  std::set<std::size_t> open_;  // lines with an end that no other line shares
};

}  // namespace

std::uint32_t DxfGrid::snap(Vec2 point) {
  const Vec3 own(std::round(point.x / kStep), std::round(point.y / kStep), 0);
  if (const auto found = cells_.find(own)) return *found;
  // Those beside it are nearer than those across a corner.
  constexpr std::array<Vec2, 8> kAround = {
      {{-1, 0}, {0, -1}, {0, 1}, {1, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}}};
  for (const Vec2 step : kAround) {
    if (const auto found = cells_.find(own + Vec3(step, 0))) return *found;
  }
  // + 0.0 makes 0 of -0.
  points_.push_back((Vec2(own) + 0.0) * kStep);
  return cells_.name(own);
}

std::vector<DxfPath> join_lines(const std::vector<DxfLine>& lines,
                                const DxfGrid& grid) {
  return Joiner(lines, grid).join();
}

}  // namespace lamina::csg
