#include "slicer/slice/detail/block_slicer.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/vec.h"
#include "ldni/image/paper_slicer.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"
#include "plane/point_grid.h"
#include "plane/predicates.h"
#include "plane/tie_distance.h"
#include "slicer/check/thin/thin_finder.h"

namespace lamina::slicer {
namespace {

// Boundary lies where a chain does, or one that ties with it [mm].
constexpr double kSearchDistance = 2 * kTieDistance;

// Where chains are as near but for this [mm], that of the first leaf counts.
constexpr double kSameDistance = 1e-9;

// Finds the leaves whose surfaces are the sides of a thin place.
//
// Contours do not say which leaf a point comes from: the moving ray has no use
// for it, and thin places are few. So the layer's chains are searched for one
// that passes through the place. The places stand in a grid, where every
// segment of a chain looks up those beside it.
class LeafSearch {
 public:
  // Sets the instances of stretches of layer `layer` of the block. Of leaves
  // whose surfaces coincide it takes the first.
  void find(const plane::ChainBlock& block, std::uint32_t layer,
            std::span<ThinStretch> stretches) {
    if (stretches.empty()) return;
    places_.clear();
    for (const ThinStretch& stretch : stretches) {
      places_.insert(places_.end(), stretch.sides.begin(), stretch.sides.end());
    }
    members_.resize(places_.size());
    std::iota(members_.begin(), members_.end(), 0U);
    grid_.fill(places_, members_);
    distances_.assign(places_.size(), kSearchDistance);
    instances_.assign(places_.size(), kNoInstance);

    // Chains come instance by instance, the first one first.
    std::uint32_t instance = kNoInstance;
    for (const plane::Chain& chain : block.layer(layer)) {
      if (chain.operand != instance) look_between_endpoints(instance);
      instance = chain.operand;
      const std::span<const Vec2> points = chain.points_in(block.points);
      for (std::size_t i = 1; i < points.size(); ++i) {
        look_along(points[i - 1], points[i], instance);
      }
      endpoints_.push_back(points.front());
      endpoints_.push_back(points.back());
    }
    look_between_endpoints(instance);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      stretches[i / 2].instances[i % 2] = instances_[i];
    }
  }

 private:
  // Upright edges belong to no chain: they stand between endpoints of chains at
  // one x, which pair up from below.
  void look_between_endpoints(std::uint32_t instance) {
    std::ranges::sort(endpoints_, precedes);
    for (std::size_t i = 1; i < endpoints_.size(); i += 2) {
      if (endpoints_[i].y > endpoints_[i - 1].y) {
        look_along(endpoints_[i - 1], endpoints_[i], instance);
      }
    }
    endpoints_.clear();
  }

  void look_along(Vec2 from, Vec2 to, std::uint32_t instance) {
    grid_.has_near(from, to, kSearchDistance, [&](std::uint32_t i) {
      const double away = distance_to_segment(places_[i], from, to);
      if (away < distances_[i] - kSameDistance) {
        distances_[i] = away;
        instances_[i] = instance;
      }
      return false;  // look at all
    });
  }

  std::vector<Vec2> places_;  // two for each stretch
  std::vector<std::uint32_t> members_;
  PointGrid grid_;
  std::vector<double> distances_;         // of the nearest chain to a place
  std::vector<std::uint32_t> instances_;  // of that chain
  std::vector<Vec2> endpoints_;           // of the chains of the instance
};

constexpr BlockSizes kFaithfulBlocks = {8, 32, 32};
constexpr BlockSizes kPaperBlocks = {16, 64, 4};
constexpr BlockSizes kDrawnBlocks = {64, 256, 4};  // each draws leaves anew

// Cuts leaves into chains and sweeps them with the kinetic ray.
class FaithfulSlicer : public BlockSlicer {
 public:
  FaithfulSlicer(const plane::BooleanProgram& program,
                 const ldni::LeafSectioner& sectioner, double pitch)
      : sectioner_(sectioner), ray_(program, {.pitch = pitch}) {}

  void section(std::uint32_t first_layer, std::uint32_t layer_count) override {
    sectioner_.cut(first_layer, layer_count, chains_);
    open_paths_ += chains_.open_paths;
  }
  bool repeats(std::uint32_t index) const override {
    return chains_.repeats(index);
  }
  void make_contours(std::uint32_t index, plane::Contours& contours) override {
    ray_.sweep(chains_, index, contours);
  }
  void find_leaves(std::uint32_t index,
                   std::span<ThinStretch> stretches) override {
    leaf_search_.find(chains_, index, stretches);
  }
  void report_to(SliceReport& report) const override {
    report.sweep += ray_.counts();
    report.open_paths += open_paths_;
  }

 private:
  const ldni::LeafSectioner& sectioner_;
  plane::KineticRay ray_;
  ldni::SectionBlock chains_;
  LeafSearch leaf_search_;
  std::uint64_t open_paths_ = 0;
};

// Draws depth images and links their samples.
class PaperBlockSlicer : public BlockSlicer {
 public:
  explicit PaperBlockSlicer(const ldni::PaperPlan& plan) : slicer_(plan) {}

  void section(std::uint32_t first_layer, std::uint32_t layer_count) override {
    first_layer_ = first_layer;
    slicer_.sample_block(first_layer, layer_count);
  }
  void make_contours(std::uint32_t index, plane::Contours& contours) override {
    slicer_.build_layer(first_layer_ + index, contours);
  }
  void report_to(SliceReport& report) const override {
    report.paper += slicer_.counts();
  }

 private:
  ldni::PaperSlicer slicer_;
  std::uint32_t first_layer_ = 0;
};

Plan plan_faithful(const csg::Scene& scene, const Settings& settings,
                   const ldni::LayerGrid& grid) {
  auto sectioner = std::make_shared<ldni::LeafSectioner>(scene, grid);
  auto program =
      std::make_shared<const plane::BooleanProgram>(csg::program_of(scene));
  return {kFaithfulBlocks,
          [program, sectioner, pitch = settings.ray_pitch] {
            return std::make_unique<FaithfulSlicer>(*program, *sectioner,
                                                    pitch);
          },
          {}};
}

Plan plan_paper(const csg::Scene& scene, const Settings& settings,
                const ldni::LayerGrid& grid) {
  // The paper's rays are as far apart as its layers.
  const double pitch =
      settings.ray_pitch > 0 ? settings.ray_pitch : settings.layer_thickness;
  const auto plan = std::make_shared<const ldni::PaperPlan>(
      ldni::make_paper_plan(scene, grid, pitch, settings.paper));
  BlockSizes blocks = settings.paper.sampler == ldni::SamplerKind::kScanline
                          ? kPaperBlocks
                          : kDrawnBlocks;
  blocks.largest = std::min(blocks.largest, plan->layers_per_block);
  return {blocks, [plan] { return std::make_unique<PaperBlockSlicer>(*plan); },
          plan->renderer};
}

}  // namespace

Plan plan_blocks(const csg::Scene& scene, const Settings& settings,
                 const ldni::LayerGrid& grid) {
  return settings.contour == ContourMode::kPaper
             ? plan_paper(scene, settings, grid)
             : plan_faithful(scene, settings, grid);
}

}  // namespace lamina::slicer
