#include "bench/section_rival/sectioner.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace lamina::rival {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

// A point this near to the line through its neighbours is left out [units]:
// what rounding the points to whole units explains.
constexpr double kCollinear = 1.5;

std::uint64_t edge(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

cInt to_units(double value) {
  return static_cast<cInt>(value + std::copysign(0.5, value));
}

bool is_collinear(const IntPoint& a, const IntPoint& b, const IntPoint& c) {
  const auto acx = static_cast<double>(c.X - a.X);
  const auto acy = static_cast<double>(c.Y - a.Y);
  const auto abx = static_cast<double>(b.X - a.X);
  const auto aby = static_cast<double>(b.Y - a.Y);
  const double cross = acx * aby - acy * abx;
  const double length2 = acx * acx + acy * acy;
  const double along = acx * abx + acy * aby;
  return cross * cross <= kCollinear * kCollinear * length2 && along >= 0 &&
         along <= length2;
}

// Adds to an open path, leaving out the middle of three on a line.
void append(Path& path, const IntPoint& point) {
  const std::size_t size = path.size();
  if (size > 0 && path.back() == point) return;
  if (size > 1 && is_collinear(path[size - 2], path[size - 1], point)) {
    path.back() = point;
  } else {
    path.push_back(point);
  }
}

// Does the same where the path's end meets its beginning.
void close(Path& path) {
  while (path.size() > 2 &&
         (path.back() == path.front() ||
          is_collinear(path[path.size() - 2], path.back(), path.front()))) {
    path.pop_back();
  }
  if (path.size() > 2 && is_collinear(path.back(), path[0], path[1])) {
    path.front() = path.back();
    path.pop_back();
  }
}

}  // namespace

void IntBox::add(const IntPoint& point) {
  low.X = std::min(low.X, point.X);
  low.Y = std::min(low.Y, point.Y);
  high.X = std::max(high.X, point.X);
  high.Y = std::max(high.Y, point.Y);
}

void IntBox::add(const IntBox& box) {
  low.X = std::min(low.X, box.low.X);
  low.Y = std::min(low.Y, box.low.Y);
  high.X = std::max(high.X, box.high.X);
  high.Y = std::max(high.Y, box.high.Y);
}

IntBox box_of(const Path& path) {
  IntBox box;
  for (const IntPoint& point : path) box.add(point);
  return box;
}

Path& PathPool::next() {
  if (used_ == paths_.size()) paths_.push_back(std::make_unique<Path>());
  Path& path = *paths_[used_++];
  path.clear();
  return path;
}

Heights::Heights(const ldni::LayerGrid& grid)
    : first_(grid.section_z(0)), layers_per_mm_(1 / grid.thickness()) {
  for (std::uint32_t k = 0; k < grid.layer_count(); ++k) {
    sections_.push_back(grid.section_z(k));
    thresholds_.push_back(grid.threshold(k));
  }
}

std::uint32_t Heights::layers_below(double z) const {
  const double guess = (z - first_) * layers_per_mm_;
  const std::size_t count = thresholds_.size();
  std::size_t layers =
      guess <= 0 ? 0 : std::min(count, static_cast<std::size_t>(guess));
  while (layers > 0 && !(z > thresholds_[layers - 1])) --layers;
  while (layers < count && z > thresholds_[layers]) ++layers;
  return static_cast<std::uint32_t>(layers);
}

void MeshSection::start(std::vector<Vec3>& vertices,
                        const std::vector<Triangle>& triangles, bool is_mirror,
                        const Heights& heights) {
  std::swap(vertices_, vertices);
  triangles_ = &triangles;
  is_mirror_ = is_mirror;
  levels_.resize(vertices_.size());
  first_layer_ = kNone;
  end_layer_ = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const std::uint32_t level = heights.layers_below(vertices_[i].z);
    levels_[i] = level;
    first_layer_ = std::min(first_layer_, level);
    end_layer_ = std::max(end_layer_, level);
  }
  active_.clear();
  sort_triangles();
}

// Stable, so that neighbours stay neighbours.
void MeshSection::sort_triangles() {
  begins_.assign(end_layer_ - first_layer_ + 2, 0);
  met_.clear();
  for (std::uint32_t i = 0; i < triangles_->size(); ++i) {
    const auto& [a, b, c] = (*triangles_)[i];
    const std::uint32_t first =
        std::min(std::min(levels_[a], levels_[b]), levels_[c]);
    if (levels_[a] == first && levels_[b] == first && levels_[c] == first) {
      continue;
    }
    met_.push_back({i, first - first_layer_});
    ++begins_[first - first_layer_ + 2];
  }
  for (std::size_t i = 2; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  sorted_.resize(met_.size());
  for (const auto& [triangle, row] : met_) {
    sorted_[begins_[row + 1]++] = triangle;
  }
}

void MeshSection::advance(std::uint32_t layer) {
  std::erase_if(active_, [&](std::uint32_t triangle) {
    const auto& [a, b, c] = (*triangles_)[triangle];
    return std::max({levels_[a], levels_[b], levels_[c]}) <= layer;
  });
  const std::uint32_t* sorted = sorted_.data();
  const std::uint32_t row = layer - first_layer_;
  active_.insert(active_.end(), sorted + begins_[row],
                 sorted + begins_[row + 1]);
}

void LoopTracer::trace(const MeshSection& mesh, std::uint32_t layer, double z,
                       PathPool& pool, std::vector<Loop>& loops) {
  add_segments(mesh, layer, z);
  link();
  walk(pool, loops);
}

IntPoint LoopTracer::crossing(const Vec3& a, const Vec3& b, double z) const {
  const double share = (z - a.z) / (b.z - a.z);
  return {to_units((a.x + share * (b.x - a.x)) * units_per_mm_),
          to_units((a.y + share * (b.y - a.y)) * units_per_mm_)};
}

void LoopTracer::add_segments(const MeshSection& mesh, std::uint32_t layer,
                              double z) {
  segments_.clear();
  const std::vector<Vec3>& vertices = mesh.vertices();
  for (const std::uint32_t index : mesh.active()) {
    const Triangle& t = mesh.triangles()[index];
    // One vertex stands alone on its side of the layer.
    const bool above[3] = {mesh.is_above(t[0], layer),
                           mesh.is_above(t[1], layer),
                           mesh.is_above(t[2], layer)};
    const unsigned alone = above[1] == above[2]   ? 0
                           : above[0] == above[2] ? 1
                                                  : 2;
    const std::uint32_t a = t[alone];
    std::uint32_t from = t[alone == 2 ? 0 : alone + 1];
    std::uint32_t to = t[alone == 0 ? 2 : alone - 1];
    // Seen from outside the solid, the segment runs to the right.
    if (above[alone] == mesh.is_mirror()) std::swap(from, to);
    segments_.push_back({edge(a, from), edge(a, to),
                         crossing(vertices[a], vertices[from], z), kNone,
                         false});
  }
}

void LoopTracer::link() {
  const auto size = static_cast<std::uint32_t>(segments_.size());
  std::uint32_t open = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t next = i + 1 == size ? 0 : i + 1;
    if (segments_[i].end == segments_[next].start) {
      segments_[i].next = next;
      segments_[next].is_start_taken = true;
    } else {
      ++open;
    }
  }
  if (open > 0) {
    table_.assign(std::bit_ceil(std::size_t{open} * 2), 0);
    link_by_table();
  }
}

void LoopTracer::link_by_table() {
  const std::size_t mask = table_.size() - 1;
  const auto place = [mask](std::uint64_t key) {
    return (key * 0x9E3779B97F4A7C15U >> 32) & mask;
  };
  for (std::uint32_t i = 0; i < segments_.size(); ++i) {
    if (segments_[i].is_start_taken) continue;
    std::size_t slot = place(segments_[i].start);
    while (table_[slot] != 0) slot = (slot + 1) & mask;
    table_[slot] = i + 1;
  }
  for (Segment& segment : segments_) {
    if (segment.next != kNone) continue;
    std::size_t slot = place(segment.end);
    for (; table_[slot] != 0; slot = (slot + 1) & mask) {
      Segment& other = segments_[table_[slot] - 1];
      if (other.start == segment.end && !other.is_start_taken) {
        other.is_start_taken = true;
        segment.next = table_[slot] - 1;
        break;
      }
    }
  }
}

void LoopTracer::walk(PathPool& pool, std::vector<Loop>& loops) {
  for (Segment& first : segments_) {
    if (first.next == kNone) continue;
    Path& path = pool.next();
    for (Segment* at = &first; at->next != kNone;) {
      append(path, at->point);
      at = &segments_[std::exchange(at->next, kNone)];
    }
    close(path);
    if (path.size() > 2) loops.push_back({&path, box_of(path)});
  }
}

}  // namespace lamina::rival
