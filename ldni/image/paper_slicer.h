#pragma once
// `--contour paper`: layers by the method of Zeng et al. 2011, whole.
//
// The parts of this room, in the order in which data pass them:
//
//   ray_grid.h      the rays of a layer, and boxes of whole rays and layers
//                   around leaves (section 3 of the paper)
//   sampler.h       a leaf's layered depth-normal image: its samples on the
//                   rays of its box, exact or drawn by OpenGL
//   boolean.h       the CSG program along one ray: of the samples of all leaves
//                   those that bound the result stay, as intervals
//                   (section 4.2)
//   loop_builder.h  links between the samples of neighbouring rays, and the
//                   loops that they make (section 5)
//
// It is the honest baseline of the kinetic ray: with all limits of the method
// (loop_builder.h), and as fast as the method allows.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "csg/scene.h"
#include "ldni/gl/gl_context.h"
#include "ldni/image/boolean.h"
#include "ldni/image/loop_builder.h"
#include "ldni/image/paper_counts.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sample.h"
#include "ldni/image/sampler.h"
#include "ldni/section/grid.h"
#include "plane/contours.h"

namespace lamina::ldni {

struct PaperOptions {
  BoxMode boxes = BoxMode::kLocal;
  SamplerKind sampler = SamplerKind::kScanline;
};

// What all threads of a job share.
struct PaperPlan {
  // Makes a sampler for one thread.
  std::unique_ptr<Sampler> make_sampler() const;

  const csg::Scene& scene;
  const LayerGrid& layers;
  BoxMode boxes;
  SamplerKind sampler;
  RayGrid rays;
  // Layers that a block should hold at most: it keeps the depth images of all
  // leaves that it meets.
  std::uint32_t layers_per_block = 1;
  // Where contexts come from, and what draws; nothing for the exact sampler.
  std::shared_ptr<const GlPlatform> gl = {};
  std::string renderer = {};
};

// Scene and grid must outlive the plan.
//
// pitch   of the rays [mm]; the paper takes the thickness of a layer
// throws  FileError where OpenGL is asked for and missing
PaperPlan make_paper_plan(const csg::Scene& scene, const LayerGrid& layers,
                          double pitch, const PaperOptions& options);

// Makes blocks of layers, one after another; one object per thread.
class PaperSlicer {
 public:
  explicit PaperSlicer(const PaperPlan& plan);

  // Samples all leaves in layers [first_layer, first_layer + layer_count) of
  // the grid; forgets the block before.
  void sample_block(std::uint32_t first_layer, std::uint32_t layer_count);

  // Replaces `contours` by the loops of `layer` (of the grid), which the
  // sampled block holds: Boolean, then links.
  void build_layer(std::uint32_t layer, plane::Contours& contours);

  // The intervals of all rays in `layer`, which the sampled block holds; valid
  // until the next call. For what wants the depth image of the result itself.
  const LayerIntervals& intervals_of(std::uint32_t layer);

  PaperCounts counts() const;

 private:
  void gather_layer(std::uint32_t layer);
  void evaluate_layer();

  const PaperPlan& plan_;
  std::unique_ptr<Sampler> sampler_;
  RayBoolean boolean_;
  LoopBuilder loop_builder_;
  LeafImages images_;  // of the leaves in the block

  // The samples of all leaves in a layer, ray by ray.
  std::vector<std::uint32_t> ray_ends_;
  std::vector<Sample> samples_;
  LayerIntervals intervals_;

  PaperCounts counts_;
};

}  // namespace lamina::ldni
