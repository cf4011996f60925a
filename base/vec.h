#pragma once
// Names of the vector types that all stages share. Lengths are millimetres.

#include <span>

#include <glm/common.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

namespace lamina {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat4 = glm::dmat4;

// An affine map: four columns of three rows, the last column the shift.
// world = world_from_leaf * Vec4(leaf, 1).
using Affine = glm::dmat4x3;

// An axis-aligned box; empty where low > high in any coordinate.
template <typename Point>
struct BoxOf {
  Point low = Point(1e300);
  Point high = Point(-1e300);

  bool is_empty() const { return glm::any(glm::greaterThan(low, high)); }
  Point size() const { return high - low; }
  Point center() const { return (low + high) / 2.0; }
  bool holds(const BoxOf& other) const {
    return glm::all(glm::lessThanEqual(low, other.low)) &&
           glm::all(glm::greaterThanEqual(high, other.high));
  }

  // These grow the box until it holds the argument too.
  void add(const Point& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(std::span<const Point> points) {
    for (const Point& point : points) add(point);
  }
  void add(const BoxOf& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }

  // Shrinks the box to what it has in common with the other.
  void intersect(const BoxOf& other) {
    low = glm::max(low, other.low);
    high = glm::min(high, other.high);
  }
  BoxOf shifted(const Point& by) const { return {low + by, high + by}; }
};

using Box2 = BoxOf<Vec2>;
using Box3 = BoxOf<Vec3>;

}  // namespace lamina
