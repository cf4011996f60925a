#include "slicer/slice/detail/block_slicer.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "ldni/image/paper_slicer.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/slice/leaf_search.h"

namespace lamina::slicer {
namespace {

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
  bool reaches(std::uint32_t index, const Box2& box) const override {
    return std::ranges::any_of(
        chains_.layer(index), [&](const plane::Chain& chain) {
          const auto points = chain.points_in(chains_.points);
          // They advance in x.
          auto at = std::ranges::lower_bound(
              points, box.low.x, {}, [](Vec2 point) { return point.x; });
          if (at == points.end()) return false;
          if (at != points.begin()) --at;
          Box2 passed;
          for (; at != points.end(); ++at) {
            passed.add(*at);
            if (at->x > box.high.x) break;
          }
          passed.intersect(box);
          return !passed.is_empty();
        });
  }
  void make_contours(std::uint32_t index, plane::Contours& contours) override {
    ray_.sweep(chains_, index, contours);
  }
  void find_leaves(std::uint32_t index,
                   std::span<ThinStretch> stretches) override {
    places_.clear();
    for (const ThinStretch& stretch : stretches) {
      places_.insert(places_.end(), stretch.sides.begin(), stretch.sides.end());
    }
    const auto found = leaf_search_.find(chains_, index, places_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      stretches[i / 2].instances[i % 2] = found[i];
    }
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
  std::vector<Vec2> places_;  // two for each stretch
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
