#pragma once
// Cuts triangle meshes layer by layer, from the bottom up.
//
// A mesh enters the sweep at its lowest layer and leaves it after its highest.
// Its triangles are sorted by the first layer that meets them (a counting
// sort); those of the layer in hand are in a list of their own. Each gives one
// directed segment from edge to edge. A segment's end is the start of the next
// one: most often of the next triangle in the list, otherwise a hash table of
// the edges finds it. So a point is computed once, and loops close exactly.
// Points in the middle of a straight line are left out, or the two triangles of
// a quad would make the clipper work twice.

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <polyclipping/clipper.hpp>

#include "bench/section_rival/triangle_mesh.h"
#include "csg/scene.h"
#include "ldni/section/grid.h"

namespace lamina::rival {

using ClipperLib::cInt;
using ClipperLib::IntPoint;
using ClipperLib::Path;

struct IntBox {
  IntPoint low{ClipperLib::hiRange, ClipperLib::hiRange};
  IntPoint high{-ClipperLib::hiRange, -ClipperLib::hiRange};

  void add(const IntPoint& point);
  void add(const IntBox& box);
  bool meets(const IntBox& other) const {
    return low.X <= other.high.X && other.low.X <= high.X &&
           low.Y <= other.high.Y && other.low.Y <= high.Y;
  }
};

// A closed polygon of a layer; holes run clockwise.
struct Loop {
  const Path* path = nullptr;
  IntBox box;
};

IntBox box_of(const Path& path);

// Paths to be used again and again, which keep their memory.
class PathPool {
 public:
  Path& next();
  void clear() { used_ = 0; }

 private:
  std::vector<std::unique_ptr<Path>> paths_;
  std::size_t used_ = 0;
};

// Heights of the layers, ready for many questions.
class Heights {
 public:
  explicit Heights(const ldni::LayerGrid& grid);
  // Number of layers whose section a vertex at this height lies above.
  std::uint32_t layers_below(double z) const;
  double section_z(std::uint32_t layer) const { return sections_[layer]; }

 private:
  double first_ = 0;
  double layers_per_mm_ = 0;
  std::vector<double> sections_;
  std::vector<double> thresholds_;  // a vertex must be higher to be above
};

// One mesh on its way through the layers. `start` makes it another mesh's.
class MeshSection {
 public:
  // vertices   in the world
  // is_mirror  whether the triangles run clockwise, seen from outside
  // triangles  must live as long as layers are cut
  void start(std::vector<Vec3>& vertices,
             const std::vector<Triangle>& triangles, bool is_mirror,
             const Heights& heights);

  // Layers [first, end) meet the mesh.
  std::uint32_t first_layer() const { return first_layer_; }
  std::uint32_t end_layer() const { return end_layer_; }

  // Appends the triangles that `layer` meets; to be called for every layer.
  void advance(std::uint32_t layer);

  const std::vector<std::uint32_t>& active() const { return active_; }
  const std::vector<Triangle>& triangles() const { return *triangles_; }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  bool is_above(std::uint32_t vertex, std::uint32_t layer) const {
    return levels_[vertex] > layer;
  }
  bool is_mirror() const { return is_mirror_; }

 private:
  void sort_triangles();

  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> levels_;  // layers below each vertex
  const std::vector<Triangle>* triangles_ = nullptr;
  bool is_mirror_ = false;
  std::uint32_t first_layer_ = 0;
  std::uint32_t end_layer_ = 0;
  // Triangles that a layer meets, and the first one, from first_layer_ on.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> met_;
  std::vector<std::uint32_t> sorted_;  // triangles by their first layer
  std::vector<std::uint32_t> begins_;  // of the layers, in sorted_
  std::vector<std::uint32_t> active_;
};

// Makes loops of a mesh's segments.
class LoopTracer {
 public:
  // units_per_mm  of the clipper's integers
  explicit LoopTracer(double units_per_mm) : units_per_mm_(units_per_mm) {}

  // Appends the loops of the layer to `loops`; their points are in `pool`.
  void trace(const MeshSection& mesh, std::uint32_t layer, double z,
             PathPool& pool, std::vector<Loop>& loops);

 private:
  // From the edge `start` to the edge `end`; the edges by their two vertices.
  struct Segment {
    std::uint64_t start;
    std::uint64_t end;
    IntPoint point;  // of start
    std::uint32_t next;
    bool is_start_taken;
  };

  void add_segments(const MeshSection& mesh, std::uint32_t layer, double z);
  IntPoint crossing(const Vec3& a, const Vec3& b, double z) const;
  void link();
  void link_by_table();
  void walk(PathPool& pool, std::vector<Loop>& loops);

  double units_per_mm_;
  std::vector<Segment> segments_;
  std::vector<std::uint32_t> table_;  // hash of start edge to segment + 1
};

}  // namespace lamina::rival
