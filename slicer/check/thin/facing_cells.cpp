#include "slicer/check/thin/facing_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>

namespace lamina::slicer {
namespace {

// Cells for each edge, at most: more would cost more to clear than they save.
constexpr double kCellsPerEdge = 4;

// Directions fall into sectors by y / (|x| + |y|), which needs no angle.
// kFacingAngle spans 8.4 of them at most.
constexpr int kSectorsInQuadrant = 16;
constexpr int kSectors = 4 * kSectorsInQuadrant;
constexpr int kReach = 10;
static_assert(kFacingAngle * kSectorsInQuadrant + 1 < kReach);

int sector_of(Vec2 along) {
  const double share = along.y / (std::abs(along.x) + std::abs(along.y));
  const double quadrants = along.x >= 0 ? 1 + share : 3 - share;
  return static_cast<int>(quadrants * kSectorsInQuadrant) % kSectors;
}

// The sectors from `first` counter-clockwise to `last`.
std::uint64_t arc(int first, int last) {
  const int more = (last - first + kSectors) % kSectors;
  const std::uint64_t ones = ~std::uint64_t{0} >> (kSectors - 1 - more);
  return std::rotl(ones, first);
}

std::uint64_t widen(std::uint64_t sectors, int by) {
  return sectors | std::rotl(sectors, by) | std::rotr(sectors, by);
}

// The sectors that face one of these.
std::uint64_t facing(std::uint64_t sectors) {
  static_assert(kReach == 1 + 2 + 4 + 3);
  const std::uint64_t opposite = std::rotl(sectors, kSectors / 2);
  return widen(widen(widen(widen(opposite, 1), 2), 4), 3);
}

// The sectors of an edge and of the turn at its beginning.
std::uint64_t directions_of(const LayerEdge& previous, const LayerEdge& edge) {
  const int before = sector_of(previous.along);
  const int here = sector_of(edge.along);
  return cross(previous.along, edge.along) >= 0 ? arc(before, here)
                                                : arc(here, before);
}

}  // namespace

void FacingCells::build(std::span<const LayerEdge> edges, double width) {
  edges_ = edges;
  // A little more than half the width: rounding must not hide an edge.
  margin_ = width * (0.5 + 1e-6);
  has_facing_ = false;
  if (edges.empty()) return;
  choose_cells();
  mark_directions();
  if (!has_facing_) return;
  list_members();
  last_gather_.assign(edges.size(), 0);
  gather_ = 0;
}

void FacingCells::choose_cells() {
  Box2 box;
  for (const LayerEdge& edge : edges_) box.add(edge.from);
  // Where all edges are long they would stand in too many cells.
  constexpr double kMostCells = 64;
  double length = 0;
  for (const LayerEdge& edge : edges_) {
    const Vec2 along = glm::abs(edge.to() - edge.from);
    length += along.x + along.y;
  }
  const auto count = static_cast<double>(edges_.size());
  grid_ = {kCellsPerEdge * count, box,
           std::max(2 * margin_, length / (kMostCells * count))};
}

template <typename Visit>
void FacingCells::visit_cells(const LayerEdge& edge, const Visit& visit) const {
  grid_.visit_cells(edge.from, edge.to(), Vec2(margin_), visit);
}

void FacingCells::mark_directions() {
  directions_.assign(grid_.size(), 0);
  edge_directions_.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const std::uint64_t sectors =
        directions_of(edges_[edges_[i].previous], edges_[i]);
    edge_directions_[i] = sectors;
    visit_cells(edges_[i],
                [&](std::size_t cell) { directions_[cell] |= sectors; });
  }
  for (std::uint64_t& sectors : directions_) {
    if ((sectors & facing(sectors)) == 0) sectors = 0;
    has_facing_ |= sectors != 0;
  }
}

void FacingCells::list_members() {
  members_.fill(directions_.size(), [this](const auto& list) {
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      visit_cells(edges_[i], [&](std::size_t cell) {
        if (directions_[cell] != 0) list(cell, i);
      });
    }
  });
}

void FacingCells::gather(std::uint32_t edge,
                         std::vector<std::uint32_t>& neighbours) {
  neighbours.clear();
  ++gather_;
  const std::uint64_t wanted = facing(edge_directions_[edge]);
  visit_cells(edges_[edge], [&](std::size_t cell) {
    if ((directions_[cell] & wanted) == 0) return;
    for (const std::uint32_t member : members_[cell]) {
      if (last_gather_[member] == gather_) continue;
      last_gather_[member] = gather_;
      neighbours.push_back(member);
    }
  });
}

}  // namespace lamina::slicer
