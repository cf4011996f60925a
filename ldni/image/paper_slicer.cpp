#include "ldni/image/paper_slicer.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/thread_clock.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/boolean.h"
#include "ldni/image/gl_sampler.h"
#include "ldni/image/interval.h"
#include "ldni/image/loop_builder.h"
#include "ldni/image/scanline_sampler.h"

namespace lamina::ldni {
namespace {

// Pixels that the images of a block may have together, some 50 bytes each with
// their samples. A jewel in local boxes needs far less; fine rays and global
// boxes of many leaves are what this is for. Drawn blocks may be larger, up to
// 100 MB: each makes triangles of whole leaves.
constexpr std::uint64_t kPixelsPerBlock = 1 << 18;
constexpr std::uint64_t kDrawnPixelsPerBlock = 1 << 21;

RayGrid make_rays(const csg::Scene& scene, double pitch) {
  if (scene.box.is_empty()) return {};
  return {scene.box.low.x, scene.box.high.x, pitch};
}

// Of the rays and layers where `instance` is sampled.
GridBox sample_box(const PaperPlan& plan, const csg::Instance& instance) {
  const GridBox local = local_box(instance.box, plan.rays, plan.layers);
  // Leaves that meet no ray stay out of either kind of image.
  if (plan.boxes == BoxMode::kLocal || local.is_empty()) return local;
  return global_box(plan.rays, plan.layers);
}

GlMethod gl_method(SamplerKind kind) {
  return kind == SamplerKind::kGlPeeling ? GlMethod::kPeeling : GlMethod::kList;
}

std::uint32_t choose_layers_per_block(const PaperPlan& plan) {
  std::uint64_t pixels = 0;  // of the whole job
  for (const csg::Instance& instance : plan.scene.instances) {
    pixels += sample_box(plan, instance).pixel_count();
  }
  const std::uint64_t most = plan.sampler == SamplerKind::kScanline
                                 ? kPixelsPerBlock
                                 : kDrawnPixelsPerBlock;
  const std::uint64_t layers =
      most * plan.layers.layer_count() / std::max<std::uint64_t>(pixels, 1);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
      layers, 1, std::max(plan.layers.layer_count(), 1U)));
}

}  // namespace

PaperPlan::PaperPlan(const csg::Scene& scene_in, const LayerGrid& layers_in,
                     double pitch, const PaperOptions& options)
    : scene(scene_in),
      layers(layers_in),
      boxes(options.boxes),
      sampler(options.sampler),
      rays(make_rays(scene_in, pitch)),
      layers_per_block(choose_layers_per_block(*this)) {
  if (sampler == SamplerKind::kScanline) return;
  const GlVersion version = least_version(gl_method(sampler));
  gl = open_gl(version);
  renderer = renderer_name(*gl->make_context(version));
}

std::unique_ptr<Sampler> PaperPlan::make_sampler() const {
  if (sampler == SamplerKind::kScanline) {
    return std::make_unique<ScanlineSampler>(scene, rays, layers);
  }
  return std::make_unique<GlSampler>(scene, rays, layers,
                                     make_face_raster(*gl, gl_method(sampler)));
}

struct PaperSlicer::State {
  explicit State(const PaperPlan& plan_in)
      : plan(plan_in),
        sampler(plan_in.make_sampler()),
        boolean(plan_in.scene) {}

  void gather_layer(std::uint32_t layer);
  void evaluate_layer();

  const PaperPlan& plan;
  std::unique_ptr<Sampler> sampler;
  RayBoolean boolean;
  LoopBuilder loop_builder;
  LeafImages images;  // of the block

  // Of the layer at hand: the samples of all leaves, ray by ray.
  std::vector<std::uint32_t> ray_ends;
  std::vector<Sample> samples;
  LayerIntervals intervals;

  PaperCounts counts;
};

PaperSlicer::PaperSlicer(const PaperPlan& plan)
    : state_(std::make_unique<State>(plan)) {}

PaperSlicer::~PaperSlicer() = default;

PaperCounts PaperSlicer::counts() const {
  PaperCounts counts = state_->counts;
  counts.repaired_pixels = state_->sampler->repaired_pixels();
  return counts;
}

void PaperSlicer::sample_block(std::uint32_t first_layer,
                               std::uint32_t layer_count) {
  const PaperPlan& plan = state_->plan;
  state_->images.clear();
  for (std::uint32_t i = 0; i < plan.scene.instances.size(); ++i) {
    const GridBox box = clip_to_layers(
        sample_box(plan, plan.scene.instances[i]), first_layer, layer_count);
    if (!box.is_empty()) state_->sampler->sample(i, box, state_->images);
  }
  state_->counts.pixels += state_->images.ends.size();
  state_->counts.samples += state_->images.samples.size();
}

void PaperSlicer::build_layer(std::uint32_t layer, Contours& contours) {
  State& state = *state_;
  state.counts.boolean_seconds += measure_seconds([&] {
    state.gather_layer(layer);
    state.evaluate_layer();
  });
  state.counts.link_seconds += measure_seconds([&] {
    state.loop_builder.build(state.plan.rays, state.intervals, contours);
  });
  state.counts.intervals += state.intervals.intervals.size();
}

// Collects a layer's samples out of the images of all leaves: a counting sort
// by ray, through the paper's index map.
void PaperSlicer::State::gather_layer(std::uint32_t layer) {
  ray_ends.assign(plan.rays.ray_count(), 0);
  const auto for_each_ray = [&](auto&& use) {
    for (const LeafImage& image : images.images) {
      const GridBox& box = image.box;
      if (layer < box.layer_start || layer >= box.layer_end()) continue;
      for (std::uint32_t ray = 0; ray < box.ray_count; ++ray) {
        use(box.ray_start + ray,
            images.rays(image, layer - box.layer_start, ray));
      }
    }
  };
  for_each_ray([&](std::uint32_t ray, std::span<const Sample> found) {
    ray_ends[ray] += static_cast<std::uint32_t>(found.size());
  });
  const std::uint32_t total =
      std::reduce(ray_ends.begin(), ray_ends.end(), std::uint32_t{0});
  std::exclusive_scan(ray_ends.begin(), ray_ends.end(), ray_ends.begin(),
                      std::uint32_t{0});
  samples.resize(total);
  for_each_ray([&](std::uint32_t ray, std::span<const Sample> found) {
    std::copy(found.begin(), found.end(), samples.begin() + ray_ends[ray]);
    ray_ends[ray] += static_cast<std::uint32_t>(found.size());
  });
}

void PaperSlicer::State::evaluate_layer() {
  intervals.clear();
  std::size_t begin = 0;
  for (const std::uint32_t end : ray_ends) {
    boolean.evaluate({samples.data() + begin, end - begin},
                     intervals.intervals);
    intervals.ends.push_back(
        static_cast<std::uint32_t>(intervals.intervals.size()));
    begin = end;
  }
}

}  // namespace lamina::ldni
