#include "ldni/section/leaf_section.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <mutex>
#include <unordered_map>
#include <utility>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "ldni/section/detail/csg_pruning.h"
#include "ldni/section/detail/loft_section.h"
#include "ldni/section/detail/mesh_index.h"
#include "ldni/section/detail/mesh_section.h"
#include "plane/chain_builder.h"

namespace lamina::ldni {

namespace detail {

struct SectionScratch {
  BlockLayers layers;
  plane::ChainBuilder builder;
  LoftSectioner lofts;
  MeshSectioner meshes;
};

}  // namespace detail

namespace {

using detail::LayerSpan;

// An instance is looked for this much [mm] beyond its box, which may have been
// rounded in another way than its vertices.
constexpr double kBoxMargin = 1e-6;

bool boxes_meet(const csg::Instance& instance, const Box3& box) {
  for (int axis = 0; axis < 2; ++axis) {
    if (instance.box.low[axis] > box.high[axis] + kBoxMargin) return false;
    if (instance.box.high[axis] < box.low[axis] - kBoxMargin) return false;
  }
  return true;
}

// The layers that an instance may reach.
struct Reach {
  std::uint32_t instance = 0;
  LayerSpan layers;
};

// Returns the instances that reach a layer. Outside the scene's box the result
// is empty whatever the leaves are there, so what lies wholly outside is left
// out, as is what others decide.
//
// They are in the order of their lengths, in powers of two, and then of where
// they begin, in steps of that. Any order would do that is the same for all
// blocks; by this one files list their loops as they always have.
std::vector<Reach> find_reaches(const csg::Scene& scene,
                                const LayerGrid& grid) {
  std::vector<Reach> reaches;
  detail::CsgPruning pruning(scene);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const csg::Instance& instance = scene.instances[i];
    if (instance.box.is_empty() || !boxes_meet(instance, scene.box) ||
        !pruning.matters(i)) {
      continue;
    }
    const LayerSpan layers = {
        grid.layers_below(instance.box.low.z - kBoxMargin),
        grid.layers_below(instance.box.high.z + kBoxMargin)};
    if (layers.first < layers.last) reaches.push_back({i, layers});
  }
  const auto place = [](const Reach& reach) {
    const int level =
        std::bit_width(reach.layers.last - reach.layers.first - 1);
    return std::pair(level, reach.layers.first >> level);
  };
  std::stable_sort(
      reaches.begin(), reaches.end(),
      [&](const Reach& a, const Reach& b) { return place(a) < place(b); });
  return reaches;
}

}  // namespace

SectionBlock::SectionBlock() = default;
SectionBlock::~SectionBlock() = default;

struct LeafSectioner::State {
  // Made by the first block that reaches the instance.
  struct IndexedMeshes {
    std::mutex making;
    std::vector<detail::MeshIndex> indices;  // one a mesh
  };

  State(const csg::Scene& s, const LayerGrid& g)
      : scene(s), grid(g), reaches(find_reaches(s, g)) {
    for (std::uint32_t i = 0; i < s.instances.size(); ++i) {
      if (!s.leaves[s.instances[i].leaf].meshes.empty()) meshes[i];
    }
  }

  void cut_instance(std::uint32_t number,
                    detail::SectionScratch& scratch) const;
  const std::vector<detail::MeshIndex>& index_meshes(
      std::uint32_t number) const;

  const csg::Scene& scene;
  const LayerGrid& grid;
  std::vector<Reach> reaches;
  // The indices of instances that have meshes.
  mutable std::unordered_map<std::uint32_t, IndexedMeshes> meshes;
};

void LeafSectioner::State::cut_instance(std::uint32_t number,
                                        detail::SectionScratch& scratch) const {
  const csg::Instance& instance = scene.instances[number];
  const csg::Leaf& leaf = scene.leaves[instance.leaf];
  const Affine& matrix = instance.world_from_leaf;
  const double determinant = glm::determinant(glm::dmat3(matrix));
  const std::int32_t mirror = determinant < 0 ? -1 : 1;
  for (const csg::Loft& loft : leaf.lofts) {
    const std::int32_t orientation = loft.is_cavity ? -mirror : mirror;
    scratch.lofts.cut(loft, matrix, number, orientation, scratch.layers,
                      scratch.builder);
  }
  if (leaf.meshes.empty()) return;
  const std::vector<detail::MeshIndex>& indices = index_meshes(number);
  for (std::size_t i = 0; i < leaf.meshes.size(); ++i) {
    scratch.meshes.cut(leaf.meshes[i], indices[i], matrix, number, mirror,
                       scratch.layers, scratch.builder);
  }
}

const std::vector<detail::MeshIndex>& LeafSectioner::State::index_meshes(
    std::uint32_t number) const {
  IndexedMeshes& indexed = meshes.at(number);
  // Not by std::call_once: an exception that passes through it aborts where no
  // memory is left, since glibc then loads a library to unwind the stack.
  const std::lock_guard lock(indexed.making);
  if (!indexed.indices.empty()) return indexed.indices;
  std::vector<detail::MeshIndex> indices;
  const csg::Instance& instance = scene.instances[number];
  for (const csg::Mesh& mesh : scene.leaves[instance.leaf].meshes) {
    indices.push_back(detail::index_mesh(mesh, instance.world_from_leaf, grid));
  }
  indexed.indices = std::move(indices);
  return indexed.indices;
}

LeafSectioner::LeafSectioner(const csg::Scene& scene, const LayerGrid& grid)
    : state_(std::make_unique<const State>(scene, grid)) {}

LeafSectioner::~LeafSectioner() = default;

void LeafSectioner::cut(std::uint32_t first_layer, std::uint32_t layer_count,
                        SectionBlock& block) const {
  if (!block.scratch) {
    block.scratch = std::make_unique<detail::SectionScratch>();
  }
  detail::SectionScratch& scratch = *block.scratch;
  block.first_layer = first_layer;
  block.layer_count = layer_count;

  // Tabulate the block's sections.
  const LayerGrid& grid = state_->grid;
  detail::BlockLayers& layers = scratch.layers;
  layers.first = first_layer;
  layers.heights.clear();
  layers.thresholds.clear();
  for (std::uint32_t l = first_layer; l < first_layer + layer_count; ++l) {
    layers.heights.push_back(grid.section_z(l));
    layers.thresholds.push_back(grid.threshold(l));
  }
  const double thickness = grid.thickness();
  layers.layers_per_mm = thickness > 0 ? 1 / thickness : 0;

  // Cut the instances that reach it.
  const std::uint64_t open_before = scratch.meshes.open_paths();
  scratch.builder.begin(block);
  const LayerSpan reached = layers.span();
  for (const auto& [instance, layers_of_it] : state_->reaches) {
    if (layers_of_it.meets(reached)) state_->cut_instance(instance, scratch);
  }
  scratch.builder.finish(block);
  block.open_paths = scratch.meshes.open_paths() - open_before;
}

}  // namespace lamina::ldni
