#pragma once
// Names for points: equal points get one name.
//
// A triangle soup of a million triangles has each point six times. One flat
// table with open addresses finds them about six times as fast as a tree.
// Nearly all of its time is waiting for memory, at places that only the hash
// knows: so where many points come at once, they are asked for before they are
// needed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

class VertexTable {
 public:
  // expected  number of different points; a guess that saves time
  explicit VertexTable(std::size_t expected = 0);

  // The number of the first point equal to this one (-0 equals 0, and NaN
  // itself), counted in the order in which points came; a point not seen before
  // is added.
  std::uint32_t name(const Vec3& point);

  // Names one point after the other, about three times as fast.
  //
  // names  as many as points
  void name(std::span<const Vec3> points, std::span<std::uint32_t> names);

  std::optional<std::uint32_t> find(const Vec3& point) const;

  // The number of different points.
  std::size_t size() const { return points_.size(); }

  // By name.
  const std::vector<Vec3>& points() const { return points_; }
  // By name; the table is empty afterwards.
  std::vector<Vec3> take_points();

 private:
  std::size_t slot_of(const Vec3& point) const;
  std::size_t slot_from(std::size_t first, const Vec3& point) const;
  std::uint32_t name_at(std::size_t slot, const Vec3& point);
  void make_room(std::size_t count);

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> slots_;  // names; a power of 2 of them, or none
  int hash_shift_ = 64;
};

// Keeps the points that corners name, in the order in which they first do, and
// renames the corners.
//
// faces  ranges of names
template <typename Faces>
void keep_named_points(std::vector<Vec3>& points, Faces& faces) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> renamed(points.size(), kUnused);
  std::vector<Vec3> named;
  for (auto& face : faces) {
    for (std::uint32_t& corner : face) {
      if (renamed[corner] == kUnused) {
        renamed[corner] = static_cast<std::uint32_t>(named.size());
        named.push_back(points[corner]);
      }
      corner = renamed[corner];
    }
  }
  points = std::move(named);
}

}  // namespace lamina::csg
