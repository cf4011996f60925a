#include "csg/lower/detail/leaf_store.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <string_view>
#include <utility>

#include "csg/boundary/convex_hull.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/degrees.h"
#include "csg/facets.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

// About how many triangles the loft would have as a mesh.
double triangle_count(const Loft& loft) {
  return 2.0 * static_cast<double>(loft.outline->size()) *
         static_cast<double>(loft.profile.size());
}

double triangle_count(const Leaf& leaf) {
  double count = 0;
  for (const Loft& loft : leaf.lofts) count += triangle_count(loft);
  for (const Mesh& mesh : leaf.meshes) {
    count += static_cast<double>(mesh.triangles.size());
  }
  return count;
}

Leaf make_leaf(Loft loft) {
  require_triangles(triangle_count(loft));
  Leaf leaf;
  leaf.lofts.push_back(std::move(loft));
  leaf.box = bound_leaf(leaf, Affine(1.0));
  return leaf;
}

// Half of the rings' angles lie off the poles: a sphere ends in two small
// polygons, not in two points.
std::vector<Vec2> sphere_profile(int fragments) {
  const int rings = (fragments + 1) / 2;
  std::vector<Vec2> profile;
  for (int i = rings - 1; i >= 0; --i) {
    const double angle_deg = 180.0 * (i + 0.5) / rings;
    profile.push_back({sin_deg(angle_deg), cos_deg(angle_deg)});
  }
  return profile;
}

// Equal bytes give equal hashes; more is not asked of it.
std::uint64_t hash(const Leaf& leaf) {
  std::uint64_t state = 0;
  const auto add = [&state](const auto& values) {
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                 values.size() * sizeof values[0]);
    state = std::rotl(state, 23) ^ std::hash<std::string_view>()(bytes);
  };
  for (const Loft& loft : leaf.lofts) add(*loft.outline), add(loft.profile);
  for (const Mesh& mesh : leaf.meshes) add(mesh.vertices);
  return state;
}

bool are_equal(const Loft& a, const Loft& b) {
  return a.is_closed_profile == b.is_closed_profile &&
         a.is_cavity == b.is_cavity && a.profile == b.profile &&
         (a.outline == b.outline || *a.outline == *b.outline);
}

bool are_equal(const Leaf& a, const Leaf& b) {
  return a.may_overlap_itself == b.may_overlap_itself &&
         a.is_convex == b.is_convex &&
         std::equal(
             a.lofts.begin(), a.lofts.end(), b.lofts.begin(), b.lofts.end(),
             [](const Loft& x, const Loft& y) { return are_equal(x, y); }) &&
         a.meshes == b.meshes;
}

}  // namespace

template <typename Make>
std::uint32_t LeafStore::find_or_add(const Key& key, Make make) {
  const auto [place, is_new] =
      primitives_.try_emplace(key, static_cast<std::uint32_t>(leaves_.size()));
  if (is_new) leaves_.push_back(make_leaf(make()));
  return place->second;
}

std::uint32_t LeafStore::unit_cube(bool center) {
  return find_or_add({Shape::kCube, center, 4, 1, 1}, [&] {
    const double low = center ? -0.5 : 0;
    const double high = low + 1;
    Loft loft;
    loft.outline = std::make_shared<const std::vector<Vec2>>(
        square(Vec2(1), center).contours.front());
    loft.profile = {{1, low}, {1, high}};
    return loft;
  });
}

std::uint32_t LeafStore::unit_sphere(int fragments) {
  return find_or_add({Shape::kSphere, true, fragments, 1, 1}, [&] {
    return Loft{circle(fragments), sphere_profile(fragments), false};
  });
}

std::uint32_t LeafStore::unit_height_cone(double r1, double r2, bool center,
                                          int fragments) {
  return find_or_add({Shape::kCone, center, fragments, r1, r2}, [&] {
    const double low = center ? -0.5 : 0;
    return Loft{circle(fragments), {{r1, low}, {r2, low + 1}}, false};
  });
}

std::uint32_t LeafStore::add(Leaf leaf) {
  require_triangles(triangle_count(leaf));
  const std::uint64_t key = hash(leaf);
  const auto [begin, end] = others_.equal_range(key);
  for (auto other = begin; other != end; ++other) {
    if (are_equal(leaves_[other->second], leaf)) return other->second;
  }
  leaf.box = bound_leaf(leaf, Affine(1.0));
  const auto id = static_cast<std::uint32_t>(leaves_.size());
  leaves_.push_back(std::move(leaf));
  others_.emplace(key, id);
  return id;
}

SharedOutline LeafStore::circle(int n) {
  SharedOutline& table = circles_[n];
  if (!table) {
    table = std::make_shared<const std::vector<Vec2>>(csg::unit_circle(n));
  }
  return table;
}

const Mesh& HullTable::find_or_make(Scene scene) {
  const auto [place, is_new] = hulls_.try_emplace(key_of(scene));
  if (is_new) place->second = convex_hull(std::move(scene));
  return place->second;
}

HullTable::Key HullTable::key_of(const Scene& scene) {
  std::vector<std::uint32_t> ids;
  for (const Leaf& leaf : scene.leaves) ids.push_back(leaves_.add(leaf));
  Key key{scene.program.size()};
  for (const plane::BooleanNode& node : scene.program) {
    key.push_back(static_cast<std::uint64_t>(node.op));
    key.push_back(node.parent);
    key.push_back(node.is_minuend ? 1 : 0);
  }
  for (const Instance& instance : scene.instances) {
    key.push_back(ids[instance.leaf]);
    key.push_back(instance.parent);
    key.push_back((instance.is_minuend ? 1 : 0) + (instance.is_flat ? 2 : 0));
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) {
        key.push_back(std::bit_cast<std::uint64_t>(
            instance.world_from_leaf[column][row]));
      }
    }
  }
  return key;
}

}  // namespace lamina::csg
