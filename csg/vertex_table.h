#pragma once
// Names for points: equal points get one name.
//
// A triangle soup of a million triangles has each point six times. One flat
// table with open addresses finds them in one pass over the corners, about six
// times as fast as a tree and without a node for each point.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "csg/vec.h"

namespace lamina::csg {

class VertexTable {
 public:
  // The number of the first point equal to this one (-0 equals 0), counted in
  // the order in which points came; a point not seen before is added.
  std::uint32_t name(const Vec3& point);

  std::optional<std::uint32_t> find(const Vec3& point) const;

  // By name; the table is empty afterwards.
  std::vector<Vec3> take_points();

 private:
  // Where the point's name stands, or would stand.
  std::size_t slot_of(const Vec3& point) const;
  void grow();

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> slots_;  // names; a power of 2 of them, or none
  int hash_shift_ = 64;
};

}  // namespace lamina::csg
