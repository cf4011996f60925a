#pragma once
// `--contour paper`: layers by the method of Zeng et al. 2011, whole.
//
// Leaves are sampled in their local boxes, the CSG program is evaluated ray by
// ray, the surviving samples are linked to loops. It is the honest baseline of
// the kinetic ray: limits included (loop_builder.h), and made as fast as the
// method allows.

#include <cstdint>
#include <memory>
#include <string>

#include "csg/scene.h"
#include "ldni/gl/gl_context.h"
#include "ldni/image/paper_counts.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sampler.h"
#include "ldni/section/contours.h"
#include "ldni/section/grid.h"

namespace lamina::ldni {

// How the samples are made: exactly, or drawn by OpenGL, by a list of fragments
// or by the paper's depth peeling.
enum class SamplerKind { kScanline, kGl, kGlPeeling };

struct PaperOptions {
  BoxMode boxes = BoxMode::kLocal;
  SamplerKind sampler = SamplerKind::kScanline;
};

// What all threads of a job share. Scene and grid must outlive it.
struct PaperPlan {
  // pitch   of the rays [mm]; the paper takes the thickness of a layer
  // throws  FileError where OpenGL is asked for and missing
  PaperPlan(const csg::Scene& scene, const LayerGrid& layers, double pitch,
            const PaperOptions& options);

  // For one thread.
  std::unique_ptr<Sampler> make_sampler() const;

  const csg::Scene& scene;
  const LayerGrid& layers;
  BoxMode boxes;
  SamplerKind sampler;
  // Of the GL samplers: where contexts come from, and what draws.
  std::shared_ptr<const GlPlatform> gl;
  std::string renderer;
  RayGrid rays;
  // Layers that a block should hold at most: it keeps the depth images of all
  // leaves that it meets.
  std::uint32_t layers_per_block = 1;
};

// Blocks of layers one after another; one object per thread.
class PaperSlicer {
 public:
  explicit PaperSlicer(const PaperPlan& plan);
  ~PaperSlicer();
  PaperSlicer(const PaperSlicer&) = delete;
  PaperSlicer& operator=(const PaperSlicer&) = delete;

  // Samples all leaves in layers [first_layer, first_layer + layer_count) of
  // the grid; forgets the block before.
  void sample_block(std::uint32_t first_layer, std::uint32_t layer_count);

  // Replaces `contours` by the loops of `layer` (of the grid), which the
  // sampled block holds: Boolean, then links.
  void build_layer(std::uint32_t layer, Contours& contours);

  PaperCounts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::ldni
