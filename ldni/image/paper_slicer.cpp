#include "ldni/image/paper_slicer.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/thread_clock.h"
#include "ldni/gl/face_raster.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {
namespace {

// Pixels that the images of a block may have together, some 50 bytes each with
// their samples. A jewel in local boxes needs far less than this bound, which
// is for fine rays and for global boxes of many leaves. Drawn blocks may be
// larger, up to 100 MB, as each makes triangles of whole leaves.
constexpr std::uint64_t kPixelsPerBlock = 1 << 18;
constexpr std::uint64_t kDrawnPixelsPerBlock = 1 << 21;

RayGrid make_rays(const csg::Scene& scene, double pitch) {
  if (scene.box.is_empty()) return {};
  return {scene.box.low.x, scene.box.high.x, pitch};
}

// Returns the rays and layers where `instance` is sampled.
GridBox sample_box(const PaperPlan& plan, const csg::Instance& instance) {
  const GridBox local = local_box(instance.box, plan.rays, plan.layers);
  // Leaves that meet no ray stay out of either kind of image.
  if (plan.boxes == BoxMode::kLocal || local.is_empty()) return local;
  return global_box(plan.rays, plan.layers);
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

// Returns how many samples the fullest pixel of `image` has.
std::uint32_t count_peels(const LeafImages& images, const LeafImage& image) {
  const std::size_t first = image.first_pixel;
  std::uint32_t begin = first == 0 ? 0 : images.ends[first - 1];
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < image.box.pixel_count(); ++i) {
    const std::uint32_t end = images.ends[first + i];
    most = std::max(most, end - begin);
    begin = end;
  }
  return most;
}

}  // namespace

PaperPlan make_paper_plan(const csg::Scene& scene, const LayerGrid& layers,
                          double pitch, const PaperOptions& options) {
  PaperPlan plan = {scene, layers, options.boxes, options.sampler,
                    make_rays(scene, pitch)};
  plan.layers_per_block = choose_layers_per_block(plan);
  if (plan.sampler == SamplerKind::kScanline) return plan;
  plan.gl = open_gl();
  plan.renderer = renderer_name(*plan.gl->make_context());
  return plan;
}

std::unique_ptr<Sampler> PaperPlan::make_sampler() const {
  if (sampler == SamplerKind::kScanline) {
    return make_scanline_sampler(scene, rays, layers);
  }
  return make_gl_sampler(scene, rays, layers, make_face_raster(*gl));
}

PaperSlicer::PaperSlicer(const PaperPlan& plan)
    : plan_(plan), sampler_(plan.make_sampler()), boolean_(plan.scene) {
  counts_.leaves.resize(plan.scene.instances.size());
}

PaperCounts PaperSlicer::counts() const {
  PaperCounts counts = counts_;
  counts.repaired_pixels = sampler_->repaired_pixels();
  return counts;
}

void PaperSlicer::sample_block(std::uint32_t first_layer,
                               std::uint32_t layer_count) {
  images_.clear();
  for (std::uint32_t i = 0; i < plan_.scene.instances.size(); ++i) {
    const GridBox box = clip_to_layers(
        sample_box(plan_, plan_.scene.instances[i]), first_layer, layer_count);
    if (!box.is_empty()) sampler_->sample({i, box}, images_);
  }
  for (const LeafImage& image : images_.images) {
    LeafImageSize& leaf = counts_.leaves[image.instance];
    leaf.pixels += image.box.pixel_count();
    leaf.peels = std::max(leaf.peels, count_peels(images_, image));
  }
  counts_.samples += images_.samples.size();
}

const LayerIntervals& PaperSlicer::intervals_of(std::uint32_t layer) {
  counts_.boolean_seconds += measure_seconds([&] {
    gather_layer(layer);
    evaluate_layer();
  });
  counts_.intervals += intervals_.intervals.size();
  return intervals_;
}

void PaperSlicer::build_layer(std::uint32_t layer, plane::Contours& contours) {
  intervals_of(layer);
  counts_.link_seconds += measure_seconds(
      [&] { loop_builder_.build(plan_.rays, intervals_, contours); });
}

// Collects a layer's samples out of the images of all leaves: a counting sort
// by ray, through the paper's index map.
void PaperSlicer::gather_layer(std::uint32_t layer) {
  ray_ends_.assign(plan_.rays.ray_count(), 0);
  const auto for_each_ray = [&](auto&& use) {
    for (const LeafImage& image : images_.images) {
      const GridBox& box = image.box;
      if (layer < box.layer_start || layer >= box.layer_end()) continue;
      for (std::uint32_t ray = 0; ray < box.ray_count; ++ray) {
        use(box.ray_start + ray,
            images_.ray(image, layer - box.layer_start, ray));
      }
    }
  };
  for_each_ray([&](std::uint32_t ray, std::span<const Sample> found) {
    ray_ends_[ray] += static_cast<std::uint32_t>(found.size());
  });
  const std::uint32_t total =
      std::reduce(ray_ends_.begin(), ray_ends_.end(), std::uint32_t{0});
  std::exclusive_scan(ray_ends_.begin(), ray_ends_.end(), ray_ends_.begin(),
                      std::uint32_t{0});
  samples_.resize(total);
  for_each_ray([&](std::uint32_t ray, std::span<const Sample> found) {
    std::copy(found.begin(), found.end(), samples_.begin() + ray_ends_[ray]);
    ray_ends_[ray] += static_cast<std::uint32_t>(found.size());
  });
}

void PaperSlicer::evaluate_layer() {
  intervals_.clear();
  std::size_t begin = 0;
  for (const std::uint32_t end : ray_ends_) {
    boolean_.evaluate({samples_.data() + begin, end - begin},
                      intervals_.intervals);
    intervals_.ends.push_back(
        static_cast<std::uint32_t>(intervals_.intervals.size()));
    begin = end;
  }
}

}  // namespace lamina::ldni
