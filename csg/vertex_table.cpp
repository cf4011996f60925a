#include "csg/vertex_table.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lamina::csg {
namespace {

constexpr std::uint32_t kFree = ~std::uint32_t{0};
constexpr std::size_t kFewestSlots = 64;

// Its high bits are the good ones.
std::uint64_t hash(const Vec3& point) {
  std::uint64_t state = 0;
  for (const double x : {point.x, point.y, point.z}) {
    const auto word = std::bit_cast<std::uint64_t>(x + 0.0);  // no -0
    state = (std::rotl(state, 23) ^ word) * 0x9e3779b97f4a7c15u;
  }
  return (state ^ (state >> 32)) * 0x9e3779b97f4a7c15u;
}

}  // namespace

std::size_t VertexTable::slot_of(const Vec3& point) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(point) >> hash_shift_;
  while (slots_[slot] != kFree && points_[slots_[slot]] != point) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

std::uint32_t VertexTable::name(const Vec3& point) {
  if (2 * points_.size() >= slots_.size()) grow();
  std::uint32_t& name = slots_[slot_of(point)];
  if (name == kFree) {
    name = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }
  return name;
}

std::optional<std::uint32_t> VertexTable::find(const Vec3& point) const {
  if (slots_.empty()) return std::nullopt;
  const std::uint32_t name = slots_[slot_of(point)];
  if (name == kFree) return std::nullopt;
  return name;
}

void VertexTable::grow() {
  const std::size_t count = std::max(kFewestSlots, 2 * slots_.size());
  slots_.assign(count, kFree);
  hash_shift_ = 64 - std::countr_zero(count);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    slots_[slot_of(points_[i])] = i;
  }
}

std::vector<Vec3> VertexTable::take_points() {
  slots_.clear();
  return std::exchange(points_, {});
}

}  // namespace lamina::csg
