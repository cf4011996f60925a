#include "slicer/slice/leaf_at.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "ldni/section/leaf_section.h"
#include "slicer/slice/scene_parts.h"

namespace lamina::slicer {
namespace {

// Findings whose makers are looked for, the lowest of them: a reader has seen
// enough, and each costs a cut.
constexpr std::size_t kMostFindings = 1000;

// How far beside a place is looked for what made it [mm]: within a pixel.
constexpr double kAside = 0.02;
constexpr std::array<Vec2, 5> kAsides = {Vec2(0), Vec2(kAside, 0),
                                         Vec2(-kAside, 0), Vec2(0, kAside),
                                         Vec2(0, -kAside)};

struct Winding {
  std::uint32_t instance = 0;
  std::int32_t number = 0;
};

// The instances that contain a place of a layer, ascending.
class LeafFinder {
 public:
  LeafFinder(const csg::Scene& scene, const ldni::LayerGrid& grid)
      : sectioner_(scene, grid) {}

  std::vector<std::uint32_t> find(std::uint32_t layer, Vec2 place) {
    if (layer != layer_) sectioner_.cut(layer, 1, block_);
    layer_ = layer;
    // The chains of an instance follow each other.
    std::vector<Winding> windings;
    for (const plane::Chain& chain : block_.layer(0)) {
      const auto points = chain.points_in(block_.points);
      if (place.x < points.front().x || place.x >= points.back().x) continue;
      if (plane::y_at(points, place.x) > place.y) continue;
      if (windings.empty() || windings.back().instance != chain.operand) {
        windings.push_back({chain.operand});
      }
      windings.back().number += chain.winding;
    }
    std::vector<std::uint32_t> instances;
    for (const Winding& winding : windings) {
      if (winding.number != 0) instances.push_back(winding.instance);
    }
    std::ranges::sort(instances);
    return instances;
  }

 private:
  const ldni::LeafSectioner sectioner_;
  ldni::SectionBlock block_;
  std::uint32_t layer_ = 0xffffffff;
};

// What contains the place in one of the two layers only.
std::vector<std::uint32_t> changed_at(LeafFinder& here, LeafFinder& below,
                                      std::uint32_t layer, Vec2 place) {
  const auto now = here.find(layer, place);
  std::vector<std::uint32_t> before;
  if (layer > 0) before = below.find(layer - 1, place);
  std::vector<std::uint32_t> changed;
  std::ranges::set_symmetric_difference(now, before,
                                        std::back_inserter(changed));
  return changed;
}

// The number of the layer with that section.
std::uint32_t layer_at(const ldni::LayerGrid& grid, double section_z) {
  std::uint32_t low = 0;
  std::uint32_t high = grid.layer_count();
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (grid.section_z(middle) <= section_z ? low : high) = middle;
  }
  return low;
}

}  // namespace

void find_makers(const csg::Scene& scene, const ldni::LayerGrid& grid,
                 std::span<Finding> findings) {
  std::vector<Finding*> wanted;
  for (Finding& finding : findings) {
    if (!finding.is_minor) wanted.push_back(&finding);
  }
  if (wanted.empty()) return;
  std::ranges::stable_sort(wanted, {}, &Finding::section_z);
  if (wanted.size() > kMostFindings) wanted.resize(kMostFindings);
  // Two, for two layers.
  LeafFinder here(scene, grid);
  LeafFinder below(scene, grid);
  for (Finding* const finding : wanted) {
    const std::uint32_t layer = layer_at(grid, finding->section_z);
    // The farthest place of an overhang may be a corner of the layer.
    for (const Vec2 aside : kAsides) {
      const auto changed =
          changed_at(here, below, layer, finding->place + aside);
      if (changed.empty()) continue;
      finding->instance = changed.front();
      break;
    }
    if (finding->instance != kNoInstance) continue;
    const auto now = here.find(layer, finding->place);
    if (!now.empty()) finding->instance = now.front();
  }
}

void find_makers(const csg::Scene& scene, const ldni::LayerGrid& grid,
                 std::span<SupportContact> contacts) {
  LeafFinder finder(scene, grid);
  for (SupportContact& contact : contacts) {
    const std::uint32_t layer = layer_at(grid, contact.section_z);
    for (const Vec2 aside : kAsides) {
      for (const std::uint32_t instance :
           finder.find(layer, contact.place + aside)) {
        if (is_support(scene, scene.instances[instance])) continue;
        contact.instance = std::min(contact.instance, instance);
      }
      if (contact.instance != kNoInstance) break;
    }
  }
}

}  // namespace lamina::slicer
