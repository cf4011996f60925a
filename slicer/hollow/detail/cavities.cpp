#include "slicer/hollow/detail/cavities.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "base/union_find.h"
#include "plane/region/offset.h"
#include "slicer/check/print/layer_overlay.h"

namespace lamina::slicer::detail {
namespace {

// Nothing that stands out is looked for.
constexpr double kAnyReach = 1e9;

// Of the arcs of offsets that only ask for room [mm].
constexpr double kRoomTolerance = 0.02;

// Joins regions of neighbouring layers that overlap.
class CavityFinder {
 public:
  void take(const Layer& layer, std::size_t index) {
    LayerOverlay overlay;
    sweep_.lay_over(layer.contours, kAnyReach, overlay);
    std::vector<std::uint32_t> nodes(layer.contours.loop_count(), kNone);
    for (std::uint32_t loop = 0; loop < nodes.size(); ++loop) {
      if (overlay.areas[loop] <= 0) continue;
      nodes[loop] = sets_.add();
      regions_.push_back({index, {}});
      volumes_.push_back(0);
    }
    for (std::uint32_t loop = 0; loop < nodes.size(); ++loop) {
      const std::uint32_t owner =
          nodes[loop] != kNone ? loop : overlay.around[loop];
      if (owner >= nodes.size() || nodes[owner] == kNone) continue;
      const auto points = layer.contours.loop(loop);
      regions_[nodes[owner]].region.contours.emplace_back(points.begin(),
                                                          points.end());
      volumes_[nodes[owner]] +=
          overlay.areas[loop] * (layer.top - layer.bottom);
    }
    for (const Overlap& overlap : overlay.solids) {
      sets_.unite(below_[overlap.below], nodes[overlap.above]);
    }
    below_ = std::move(nodes);
  }

  // Keeps the layer in place while the next one is taken.
  void start(const plane::Contours& nothing) { sweep_.start(nothing); }

  std::vector<Cavity> finish() {
    std::map<std::uint32_t, Cavity> cavities;
    for (std::uint32_t node = 0; node < regions_.size(); ++node) {
      Cavity& cavity = cavities[sets_.find(node)];
      cavity.volume += volumes_[node];
      cavity.layers.push_back(std::move(regions_[node]));
    }
    std::vector<Cavity> list;
    for (auto& [node, cavity] : cavities) list.push_back(std::move(cavity));
    return list;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  OverlaySweep sweep_;
  UnionFind sets_;
  std::vector<CavityLayer> regions_;  // by node
  std::vector<double> volumes_;
  std::vector<std::uint32_t> below_;  // nodes of the last layer's loops
};

}  // namespace

std::vector<Cavity> find_cavities(std::span<const Layer> layers) {
  const plane::Contours nothing;
  CavityFinder finder;
  finder.start(nothing);
  for (std::size_t i = 0; i < layers.size(); ++i) finder.take(layers[i], i);
  return finder.finish();
}

bool has_room(const Cavity& cavity, double diameter) {
  return std::ranges::any_of(cavity.layers, [&](const CavityLayer& layer) {
    return !plane::offset(layer.region, -diameter / 2, plane::Join::kRound,
                          kRoomTolerance)
                .is_empty();
  });
}

}  // namespace lamina::slicer::detail
