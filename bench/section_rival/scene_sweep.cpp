#include "bench/section_rival/scene_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/matrix.hpp>

#include "bench/section_rival/layer_boolean.h"
#include "bench/section_rival/sectioner.h"
#include "bench/section_rival/slc_file.h"
#include "ldni/section/grid.h"

namespace lamina::rival {
namespace {

// Finest units that keep the clipper in its fast range of 30 bits, and no
// finer than 1e-7 mm.
double choose_units_per_mm(const Box3& box) {
  double reach = 0;
  for (const Vec3& corner : {box.low, box.high}) {
    reach = std::max({reach, std::abs(corner.x), std::abs(corner.y)});
  }
  double units = 1e7;
  while (reach * units > 0.9 * static_cast<double>(ClipperLib::loRange)) {
    units /= 10;
  }
  return units;
}

// Of everything, subtrahends too.
Box3 box_of_instances(const csg::Scene& scene) {
  Box3 box;
  for (const csg::Instance& instance : scene.instances) {
    box.low = glm::min(box.low, instance.box.low);
    box.high = glm::max(box.high, instance.box.high);
  }
  return box;
}

class SceneSweep {
 public:
  SceneSweep(const csg::Scene& scene, double thickness)
      : scene_(scene),
        grid_(ldni::LayerGrid::uniform(scene.box.low.z, scene.box.high.z,
                                       thickness)),
        heights_(grid_),
        units_per_mm_(choose_units_per_mm(box_of_instances(scene))),
        tracer_(units_per_mm_),
        boolean_(scene),
        meshes_(scene.leaves.size()),
        uses_(scene.leaves.size(), 0) {
    for (const csg::Instance& instance : scene.instances) {
      ++uses_[instance.leaf];
    }
    order_.resize(scene.instances.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(
        order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
          return scene.instances[a].box.low.z < scene.instances[b].box.low.z;
        });
  }

  void run(OutputFile& output) {
    SlcFile file(output, units_per_mm_);
    std::vector<const Path*> paths;
    std::uint32_t empty = 0;  // layers since the last one with a contour
    bool has_begun = false;
    for (std::uint32_t layer = 0; layer < grid_.layer_count(); ++layer) {
      enter_meshes(layer);
      cut_meshes(layer);
      boolean_.run(paths);
      if (paths.empty()) {
        if (has_begun) ++empty;
      } else {
        has_begun = true;
        for (; empty > 0; --empty) emit(layer - empty, {}, file);
        emit(layer, paths, file);
      }
      pool_.clear();
    }
    file.finish();
  }

 private:
  struct Active {
    std::uint32_t instance;
    std::unique_ptr<MeshSection> mesh;
  };

  void enter_meshes(std::uint32_t layer) {
    for (; entered_ < order_.size(); ++entered_) {
      const std::uint32_t index = order_[entered_];
      const csg::Instance& instance = scene_.instances[index];
      // Rounding may put a vertex a little outside of the box.
      constexpr double kMargin = 1e-6;  // [mm]
      if (heights_.layers_below(instance.box.low.z - kMargin) > layer) break;
      enter(index, instance, layer);
    }
  }

  void enter(std::uint32_t index, const csg::Instance& instance,
             std::uint32_t layer) {
    TriangleMesh& mesh = meshes_[instance.leaf];
    if (mesh.triangles.empty()) {
      mesh = make_triangles(scene_.leaves[instance.leaf]);
    }
    // The last user of a leaf has its vertices for itself.
    if (--uses_[instance.leaf] == 0) {
      vertices_ = std::move(mesh.vertices);
    } else {
      vertices_ = mesh.vertices;
    }
    for (Vec3& vertex : vertices_) {
      vertex = instance.world_from_leaf * Vec4(vertex, 1.0);
    }
    std::unique_ptr<MeshSection> section = take_section();
    const bool is_mirror =
        glm::determinant(glm::dmat3(instance.world_from_leaf)) < 0;
    section->start(vertices_, mesh.triangles, is_mirror, heights_);
    if (section->end_layer() > layer) {
      active_.push_back({index, std::move(section)});
    } else {
      spare_.push_back(std::move(section));
    }
  }

  std::unique_ptr<MeshSection> take_section() {
    if (spare_.empty()) return std::make_unique<MeshSection>();
    std::unique_ptr<MeshSection> section = std::move(spare_.back());
    spare_.pop_back();
    return section;
  }

  void cut_meshes(std::uint32_t layer) {
    for (const Active& active : active_) {
      if (active.mesh->first_layer() > layer) continue;
      active.mesh->advance(layer);
      loops_.clear();
      tracer_.trace(*active.mesh, layer, grid_.section_z(layer), pool_, loops_);
      if (!loops_.empty()) boolean_.add(active.instance, loops_);
    }
    std::erase_if(active_, [&](Active& active) {
      if (active.mesh->end_layer() > layer + 1) return false;
      spare_.push_back(std::move(active.mesh));
      return true;
    });
  }

  void emit(std::uint32_t layer, const std::vector<const Path*>& paths,
            SlcFile& file) const {
    file.add_layer(grid_.layer_bottom(layer), grid_.layer_top(layer), paths);
  }

  const csg::Scene& scene_;
  ldni::LayerGrid grid_;
  Heights heights_;
  double units_per_mm_;
  LoopTracer tracer_;
  LayerBoolean boolean_;
  PathPool pool_;  // of the leaves' loops
  std::vector<Loop> loops_;
  std::vector<TriangleMesh> meshes_;  // of the leaves
  std::vector<std::uint32_t> uses_;   // of the leaves, still to come
  std::vector<std::uint32_t> order_;  // instances by their lowest point
  std::size_t entered_ = 0;           // of order_
  std::vector<Active> active_;
  std::vector<std::unique_ptr<MeshSection>> spare_;
  std::vector<Vec3> vertices_;
};

}  // namespace

void slice_by_sections(const csg::Scene& scene, double thickness,
                       OutputFile& output) {
  SceneSweep(scene, thickness).run(output);
}

}  // namespace lamina::rival
