#include "csg/mesh/vertex_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace lamina::csg {
namespace {

constexpr std::uint32_t kFree = ~std::uint32_t{0};
constexpr std::size_t kFewestSlots = 64;

using Words = std::array<std::uint64_t, 3>;

// Equal for equal points, and only for these.
Words words_of(const Vec3& point) {
  return {std::bit_cast<std::uint64_t>(point.x + 0.0),  // no -0
          std::bit_cast<std::uint64_t>(point.y + 0.0),
          std::bit_cast<std::uint64_t>(point.z + 0.0)};
}

// Its high bits are the good ones.
std::uint64_t hash(const Words& words) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;
  const std::uint64_t mixed =
      (std::rotl(words[0] * kOdd, 23) ^ words[1]) * kOdd;
  return (std::rotl(mixed, 23) ^ words[2] ^ mixed >> 32) * kOdd;
}

}  // namespace

VertexTable::VertexTable(std::size_t expected) {
  if (expected > 0) make_room(expected);
  points_.reserve(expected);
}

// Where the point's name stands, or would stand.
inline std::size_t VertexTable::slot_from(std::size_t first,
                                          const Vec3& point) const {
  const Words words = words_of(point);
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = first;
  while (slots_[slot] != kFree && words_of(points_[slots_[slot]]) != words) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

std::size_t VertexTable::slot_of(const Vec3& point) const {
  return slot_from(hash(words_of(point)) >> hash_shift_, point);
}

inline std::uint32_t VertexTable::name_at(std::size_t slot, const Vec3& point) {
  std::uint32_t& name = slots_[slot];
  if (name == kFree) {
    name = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }
  return name;
}

std::uint32_t VertexTable::name(const Vec3& point) {
  make_room(points_.size() + 1);
  return name_at(slot_of(point), point);
}

void VertexTable::name(std::span<const Vec3> points,
                       std::span<std::uint32_t> names) {
  // As many as a processor has loads under way, and some more.
  constexpr std::size_t kAtOnce = 32;
  std::array<std::size_t, kAtOnce> firsts{};
  for (std::size_t begin = 0; begin < points.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, points.size() - begin);
    make_room(points_.size() + count);
    for (std::size_t i = 0; i < count; ++i) {
      firsts[i] = hash(words_of(points[begin + i])) >> hash_shift_;
      __builtin_prefetch(&slots_[firsts[i]]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t name = slots_[firsts[i]];
      if (name != kFree) __builtin_prefetch(&points_[name]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3& point = points[begin + i];
      names[begin + i] = name_at(slot_from(firsts[i], point), point);
    }
  }
}

std::optional<std::uint32_t> VertexTable::find(const Vec3& point) const {
  if (slots_.empty()) return std::nullopt;
  const std::uint32_t name = slots_[slot_of(point)];
  if (name == kFree) return std::nullopt;
  return name;
}

// Never more than half of the slots are taken.
void VertexTable::make_room(std::size_t count) {
  if (2 * count <= slots_.size()) return;
  const std::size_t slot_count =
      std::max(kFewestSlots, std::bit_ceil(2 * count));
  slots_.assign(slot_count, kFree);
  hash_shift_ = 64 - std::countr_zero(slot_count);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    slots_[slot_of(points_[i])] = i;
  }
}

std::vector<Vec3> VertexTable::take_points() {
  slots_.clear();
  return std::exchange(points_, {});
}

}  // namespace lamina::csg
