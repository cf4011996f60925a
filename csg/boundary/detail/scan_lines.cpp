#include "csg/boundary/detail/scan_lines.h"

#include <algorithm>
#include <numeric>

namespace lamina::csg {
namespace {

// Slabs of an estimate.
constexpr std::size_t kFewLines = 64;

double low_of(const ScanLines::Edge& edge) {
  return std::min(edge.begin.y, edge.end.y);
}

double high_of(const ScanLines::Edge& edge) {
  return std::max(edge.begin.y, edge.end.y);
}

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

bool ScanLines::find_slabs(double low, double high, std::size_t most) {
  sort_edges();
  borders_ = level_;
  if (2 * edges_.size() <= most) {
    for (const Edge& edge : edges_) {
      borders_.push_back(edge.begin.y);
      borders_.push_back(edge.end.y);
    }
    add_crossings();
    std::erase_if(borders_, [&](double v) { return v <= low || v >= high; });
    borders_.push_back(low);
    borders_.push_back(high);
    std::ranges::sort(borders_);
    if (borders_.size() <= most) return true;
  }
  borders_.resize(kFewLines + 1);
  for (std::size_t i = 0; i <= kFewLines; ++i) {
    const double share = static_cast<double>(i) / kFewLines;
    borders_[i] = low + share * (high - low);
  }
  return false;
}

void ScanLines::add_crossings() {
  active_.clear();
  for (const std::uint32_t i : order_) {
    const Edge& a = edges_[i];
    const Vec2 along = a.end - a.begin;
    const double low = low_of(a);
    const double high = high_of(a);
    const auto [left, right] = std::minmax(a.begin.x, a.end.x);
    std::erase_if(active_,
                  [&](std::uint32_t j) { return high_of(edges_[j]) <= low; });
    for (const std::uint32_t j : active_) {
      const Edge& b = edges_[j];
      if (std::min(b.begin.x, b.end.x) > right) continue;
      if (std::max(b.begin.x, b.end.x) < left) continue;
      const double begin = csg::cross(along, b.begin - a.begin);
      const double end = csg::cross(along, b.end - a.begin);
      if ((begin > 0) == (end > 0)) continue;
      const double share = begin / (begin - end);
      const double v = b.begin.y + share * (b.end.y - b.begin.y);
      if (v > low && v < high) borders_.push_back(v);
    }
    active_.push_back(i);
  }
}

void ScanLines::sort_edges() {
  order_.resize(edges_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::sort(order_, {},
                    [&](std::uint32_t i) { return low_of(edges_[i]); });
}

void ScanLines::begin() {
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
