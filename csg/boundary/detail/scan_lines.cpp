#include "csg/boundary/detail/scan_lines.h"

#include <algorithm>
#include <numeric>

namespace lamina::csg {
namespace {

// Of more edges the crossings are not looked for: pairs of them.
constexpr std::size_t kMostEdges = 128;

// Of more slabs lines are evenly spaced.
constexpr std::size_t kMostLines = 256;

double low_of(const ScanLines::Edge& edge) {
  return std::min(edge.begin.y, edge.end.y);
}

double high_of(const ScanLines::Edge& edge) {
  return std::max(edge.begin.y, edge.end.y);
}

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

bool ScanLines::find_slabs(double low, double high) {
  borders_ = level_;
  if (edges_.size() <= kMostEdges) {
    for (const Edge& edge : edges_) {
      borders_.push_back(edge.begin.y);
      borders_.push_back(edge.end.y);
    }
    add_crossings();
    std::erase_if(borders_, [&](double v) { return v <= low || v >= high; });
    borders_.push_back(low);
    borders_.push_back(high);
    std::ranges::sort(borders_);
    if (borders_.size() <= kMostLines) return true;
  }
  borders_.resize(kMostLines + 1);
  for (std::size_t i = 0; i <= kMostLines; ++i) {
    const double share = static_cast<double>(i) / kMostLines;
    borders_[i] = low + share * (high - low);
  }
  return false;
}

void ScanLines::add_crossings() {
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& a = edges_[i];
    const Vec2 along = a.end - a.begin;
    for (std::size_t j = i + 1; j < edges_.size(); ++j) {
      const Edge& b = edges_[j];
      if (low_of(a) >= high_of(b) || low_of(b) >= high_of(a)) continue;
      const double begin = csg::cross(along, b.begin - a.begin);
      const double end = csg::cross(along, b.end - a.begin);
      if ((begin > 0) == (end > 0)) continue;
      const double share = begin / (begin - end);
      const double v = b.begin.y + share * (b.end.y - b.begin.y);
      if (v > low_of(a) && v < high_of(a)) borders_.push_back(v);
    }
  }
}

void ScanLines::begin() {
  order_.resize(edges_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::sort(order_, {}, [&](std::uint32_t i) {
    return low_of(edges_[i]);
  });
  next_ = 0;
  active_.clear();
}

std::span<const ScanLines::Crossing> ScanLines::cross(double v) {
  for (; next_ < order_.size() && low_of(edges_[order_[next_]]) < v; ++next_) {
    active_.push_back(order_[next_]);
  }
  std::erase_if(active_,
                [&](std::uint32_t i) { return high_of(edges_[i]) <= v; });
  crossings_.clear();
  for (const std::uint32_t i : active_) {
    crossings_.push_back({edges_[i].at(v).x, &edges_[i]});
  }
  std::ranges::sort(crossings_, {}, &Crossing::u);
  return crossings_;
}

}  // namespace lamina::csg
