#include "slicer/slice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include "ldni/grid.h"
#include "ldni/leaf_section.h"
#include "slicer/compensate.h"
#include "slicer/leaf_search.h"
#include "slicer/paper_slicer.h"
#include "slicer/simplify.h"
#include "slicer/thin_finder.h"
#include "slicer/thread_clock.h"

namespace lamina::slicer {
namespace {

namespace tbb = oneapi::tbb;

// Blocks in flight, for each thread: one in work, one waiting for its turn to
// be written.
constexpr std::size_t kBlocksPerThread = 2;

// One thread's way from a block of layers to contours: the back end of a
// contour mode.
class BlockSlicer {
 public:
  virtual ~BlockSlicer() = default;
  // Cuts all leaves in those layers; forgets the block before.
  virtual void section(std::uint32_t first_layer,
                       std::uint32_t layer_count) = 0;
  // Replaces `contours` by the loops of layer `index` of the block.
  virtual void make_contours(std::uint32_t index, ldni::Contours& contours) = 0;
  // Finds the leaves of thin places of that layer, if it can.
  virtual void find_leaves(std::uint32_t /*index*/,
                           std::span<ThinStretch> /*stretches*/) {}
  // Adds what was counted.
  virtual void report_to(SliceReport& report) const = 0;
};

// Leaf sections and the kinetic ray.
class FaithfulSlicer : public BlockSlicer {
 public:
  FaithfulSlicer(const csg::Scene& scene, const ldni::LeafSectioner& sectioner,
                 double pitch)
      : sectioner_(sectioner), ray_(scene, pitch) {}

  void section(std::uint32_t first_layer, std::uint32_t layer_count) override {
    sectioner_.cut(first_layer, layer_count, chains_);
    open_paths_ += chains_.open_paths;
  }
  void make_contours(std::uint32_t index, ldni::Contours& contours) override {
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
  ldni::KineticRay ray_;
  ldni::ChainBlock chains_;
  LeafSearch leaf_search_;
  std::uint64_t open_paths_ = 0;
};

// Depth images and links.
class PaperBlockSlicer : public BlockSlicer {
 public:
  explicit PaperBlockSlicer(const PaperPlan& plan) : slicer_(plan) {}

  void section(std::uint32_t first_layer, std::uint32_t layer_count) override {
    first_layer_ = first_layer;
    slicer_.sample_block(first_layer, layer_count);
  }
  void make_contours(std::uint32_t index, ldni::Contours& contours) override {
    slicer_.build_layer(first_layer_ + index, contours);
  }
  void report_to(SliceReport& report) const override {
    report.paper += slicer_.counts();
  }

 private:
  PaperSlicer slicer_;
  std::uint32_t first_layer_ = 0;
};

// Layers of a block share the walk over the leaves, so few large blocks are
// cheap; many small ones keep all threads busy and memory low.
struct BlockSizes {
  std::uint32_t smallest;  // layers
  std::uint32_t largest;
  std::uint32_t wanted_blocks;

  // Of blocks; depends on the job alone, not on the number of threads.
  std::uint32_t count(std::uint32_t layer_count) const {
    const std::uint32_t size =
        std::min(largest, std::max(layer_count / wanted_blocks, smallest));
    return (layer_count + size - 1) / size;
  }
};
constexpr BlockSizes kFaithfulBlocks = {8, 32, 32};
constexpr BlockSizes kPaperBlocks = {16, 64, 4};
constexpr BlockSizes kDrawnBlocks = {64, 256, 4};  // each draws leaves anew

// What a job's threads share, and how they get what is their own.
struct Plan {
  BlockSizes blocks = kFaithfulBlocks;
  std::function<std::unique_ptr<BlockSlicer>()> make_slicer;
  std::string renderer;  // SliceReport
};

Plan plan_faithful(const csg::Scene& scene, const Settings& settings,
                   const ldni::LayerGrid& grid) {
  auto sectioner = std::make_shared<ldni::LeafSectioner>(scene, grid);
  return {kFaithfulBlocks,
          [&scene, sectioner, pitch = settings.ray_pitch] {
            return std::make_unique<FaithfulSlicer>(scene, *sectioner, pitch);
          },
          {}};
}

Plan plan_paper(const csg::Scene& scene, const Settings& settings,
                const ldni::LayerGrid& grid) {
  auto plan = std::make_shared<PaperPlan>(scene, grid, settings);
  BlockSizes blocks =
      settings.sampler == SamplerKind::kScanline ? kPaperBlocks : kDrawnBlocks;
  blocks.largest = std::min(blocks.largest, plan->layers_per_block);
  return {blocks, [plan] { return std::make_unique<PaperBlockSlicer>(*plan); },
          plan->renderer};
}

// A layer on its way, and what was found out about it.
struct Draft {
  ldni::Contours contours;
  std::vector<ThinStretch> thin;
  std::uint64_t holes = 0;
  double area = 0;       // [mm²]
  double clearance = 0;  // as of Layer

  void measure() {
    holes = 0;
    area = 0;
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const double loop_area = ldni::signed_area(contours.loop(i));
      area += loop_area;
      holes += loop_area < 0 ? 1 : 0;
    }
  }
};

// Consecutive layers on their way through the pipeline. Blocks are used again
// and again, so that the steady state allocates nothing.
struct Block {
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  std::vector<Draft> layers;
  double section_seconds = 0;
  double sweep_seconds = 0;
  double feature_seconds = 0;
  double finish_seconds = 0;  // compensation and simplification
};

// What one thread keeps from block to block.
struct Worker {
  std::unique_ptr<BlockSlicer> slicer;
  std::optional<ThinFinder> thin_finder;  // if thin places are looked for
  Compensator compensator;
  Simplifier simplifier;
};

ldni::LayerGrid make_grid(const csg::Scene& scene, const Settings& settings) {
  if (!settings.heights.empty()) {
    return ldni::LayerGrid::at_heights(settings.heights);
  }
  return ldni::LayerGrid::uniform(scene.box.low.z, scene.box.high.z,
                                  settings.layer_thickness);
}

// Hands layers on in order. Holds back empty ones until it is known that
// another layer with a contour follows, unless each height is wanted.
class OrderedOutput {
 public:
  // features  gets the thin places of the layers; may be null
  OrderedOutput(const ldni::LayerGrid& grid, const Settings& settings,
                LayerSink& sink, FeatureCollector* features,
                SliceReport& report)
      : grid_(grid),
        keeps_empty_(!settings.heights.empty()),
        sink_(sink),
        features_(features),
        report_(report) {
    layer_.compensation = settings.compensation;
  }

  void take(std::uint32_t index, Draft& draft) {
    if (draft.contours.is_empty() && !keeps_empty_) {
      if (report_.layers > 0) ++held_back_;
      return;
    }
    for (; held_back_ > 0; --held_back_) emit(index - held_back_, empty_);
    emit(index, draft);
  }

 private:
  void emit(std::uint32_t index, Draft& draft) {
    ++report_.layers;
    report_.loops += draft.contours.loop_count();
    report_.holes += draft.holes;
    report_.points += draft.contours.points.size();
    report_.greatest_area = std::max(report_.greatest_area, draft.area);
    layer_.section_z = grid_.section_z(index);
    layer_.bottom = grid_.layer_bottom(index);
    layer_.top = grid_.layer_top(index);
    layer_.clearance = draft.clearance;
    report_.volume += draft.area * (layer_.top - layer_.bottom);
    std::swap(layer_.contours, draft.contours);
    sink_.take(layer_);
    std::swap(layer_.contours, draft.contours);
    if (features_ != nullptr) {
      report_.feature_seconds +=
          measure([&] { features_->take(layer_, draft.thin); });
    }
  }

  const ldni::LayerGrid& grid_;
  bool keeps_empty_;
  LayerSink& sink_;
  FeatureCollector* features_;
  SliceReport& report_;
  std::uint32_t held_back_ = 0;
  Draft empty_;
  Layer layer_;
};

// The pipeline.
class Job {
 public:
  Job(const Plan& plan, std::uint32_t layer_count, const Settings& settings,
      unsigned threads)
      : layer_count_(layer_count),
        workers_([&plan, &settings] {
          return Worker{plan.make_slicer(),
                        settings.min_feature > 0
                            ? std::optional<ThinFinder>(settings.min_feature)
                            : std::nullopt,
                        Compensator(settings.compensation),
                        Simplifier(settings.tolerance)};
        }),
        blocks_(kBlocksPerThread * threads),
        block_count_(plan.blocks.count(layer_count)) {}

  void run(OrderedOutput& output, SliceReport& report) {
    tbb::parallel_pipeline(
        blocks_.size(),
        tbb::make_filter<void, Block*>(
            tbb::filter_mode::serial_in_order,
            [this](tbb::flow_control& flow) { return next_block(flow); }) &
            tbb::make_filter<Block*, Block*>(
                tbb::filter_mode::parallel,
                [this](Block* block) { return make_contours(block); }) &
            tbb::make_filter<Block*, void>(
                tbb::filter_mode::serial_in_order,
                [&](Block* block) { hand_on(*block, output, report); }));
    for (const Worker& worker : workers_) {
      worker.slicer->report_to(report);
      report.losses += worker.compensator.counts();
    }
  }

 private:
  // Blocks are as equal as can be; their borders depend on the job alone.
  std::uint32_t border(std::uint32_t block) const {
    return static_cast<std::uint32_t>(std::uint64_t{layer_count_} * block /
                                      block_count_);
  }

  // Input and output keep the same order and at most blocks_.size() blocks are
  // under way, so the oldest block's memory is free again.
  Block* next_block(tbb::flow_control& flow) {
    if (started_ == block_count_) {
      flow.stop();
      return nullptr;
    }
    Block& block = blocks_[started_ % blocks_.size()];
    block.first_layer = border(started_);
    block.layer_count = border(started_ + 1) - block.first_layer;
    ++started_;
    return &block;
  }

  Block* make_contours(Block* block) {
    if (block->layers.size() < block->layer_count) {
      block->layers.resize(block->layer_count);
    }
    const std::span<Draft> layers(block->layers.data(), block->layer_count);
    // A thread's first block makes its slicer, which may open OpenGL.
    Worker* local = nullptr;
    block->section_seconds = measure([&] {
      local = &workers_.local();
      local->slicer->section(block->first_layer, block->layer_count);
    });
    Worker& worker = *local;
    block->sweep_seconds = measure([&] {
      for (std::uint32_t i = 0; i < block->layer_count; ++i) {
        worker.slicer->make_contours(i, layers[i].contours);
      }
    });
    // In the exact contours, before anything is moved or left out.
    if (worker.thin_finder) {
      block->feature_seconds = measure([&] {
        for (std::uint32_t i = 0; i < block->layer_count; ++i) {
          worker.thin_finder->find(layers[i].contours, layers[i].thin);
          worker.slicer->find_leaves(i, layers[i].thin);
        }
      });
    }
    // Simplification comes last, so that it thins out the arcs too.
    block->finish_seconds = measure([&] {
      for (Draft& layer : layers) {
        worker.compensator.compensate(layer.contours);
        worker.simplifier.simplify(layer.contours);
        layer.clearance = worker.simplifier.clearance();
        layer.measure();
      }
    });
    return block;
  }

  static void hand_on(Block& block, OrderedOutput& output,
                      SliceReport& report) {
    report.section_seconds += block.section_seconds;
    report.sweep_seconds += block.sweep_seconds;
    report.feature_seconds += block.feature_seconds;
    const double before = report.feature_seconds;
    const double seconds = measure([&] {
      for (std::uint32_t i = 0; i < block.layer_count; ++i) {
        output.take(block.first_layer + i, block.layers[i]);
      }
    });
    // Features are collected on the way.
    report.output_seconds +=
        block.finish_seconds + seconds - (report.feature_seconds - before);
  }

  std::uint32_t layer_count_;
  tbb::enumerable_thread_specific<Worker> workers_;
  std::vector<Block> blocks_;
  std::uint32_t block_count_;
  std::uint32_t started_ = 0;
};

// None that would have no block.
unsigned choose_threads(const Settings& settings, std::uint32_t block_count) {
  const unsigned wanted = settings.threads != 0
                              ? settings.threads
                              : std::thread::hardware_concurrency();
  return std::max(1U, std::min(wanted, block_count));
}

// What must not happen, and would be a fault of ours, is never silent.
void warn_of_broken_promises(const SliceReport& report,
                             Diagnostics& diagnostics) {
  const auto warn = [&](std::uint64_t count, const char* what) {
    if (count == 0) return;
    diagnostics.warning({}, fmt::format("{} {}; the layers may be wrong there, "
                                        "please report",
                                        count, what));
  };
  warn(report.open_paths, "open paths in the sections of leaves were closed");
  warn(report.sweep.unbalanced_columns, "stops of the ray left a leaf open");
  warn(report.sweep.repaired_columns, "ends of boundary found no partner");
  warn(report.sweep.capped_columns, "stops of the ray did not settle");
}

// No fault of the layers either, but of what drew them.
void warn_of_repairs(const SliceReport& report, Diagnostics& diagnostics) {
  if (report.paper.repaired_pixels == 0) return;
  diagnostics.warning(
      {},
      fmt::format("{} pixels that OpenGL ({}) drew more often from one side "
                  "than from the other were sampled exactly instead",
                  report.paper.repaired_pixels, report.renderer));
}

// Too thin for the beam is no fault of the layers, but no part of the print.
void warn_of_losses(const CompensationCounts& losses, double compensation,
                    Diagnostics& diagnostics) {
  const auto warn = [&](std::uint64_t loops, const char* loop,
                        std::uint64_t gaps, const char* gap) {
    if (loops + gaps == 0) return;
    diagnostics.warning(
        {}, fmt::format("{} {} and {} {} of {} mm or less vanished in the "
                        "compensation, counted over all layers",
                        loops, loop, gaps, gap, 2 * std::abs(compensation)));
  };
  warn(losses.vanished_regions, "regions", losses.broken_walls, "walls");
  warn(losses.vanished_holes, "holes", losses.closed_gaps, "gaps");
}

[[noreturn]] void throw_empty(const SliceReport& report) {
  throw GeometryError({Severity::kError,
                       {},
                       report.losses.vanished_regions > 0
                           ? "Nothing is left of the design after compensation."
                           : "Current top level object is empty.",
                       {}});
}

}  // namespace

SliceReport slice(const csg::Scene& scene, const Settings& settings,
                  LayerSink& sink, Diagnostics& diagnostics) {
  SliceReport report;
  if (scene.box.is_empty() && settings.heights.empty()) throw_empty(report);
  const ldni::LayerGrid grid = make_grid(scene, settings);
  Plan plan;
  report.section_seconds = measure([&] {
    plan = settings.contour == ContourMode::kPaper
               ? plan_paper(scene, settings, grid)
               : plan_faithful(scene, settings, grid);
  });
  report.renderer = plan.renderer;
  std::optional<FeatureCollector> features;
  if (settings.min_feature > 0) {
    features.emplace(settings.min_feature, number_makers(scene));
  }
  sink.begin(scene.box);
  OrderedOutput output(grid, settings, sink, features ? &*features : nullptr,
                       report);
  const unsigned threads =
      choose_threads(settings, plan.blocks.count(grid.layer_count()));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  threads);
  Job(plan, grid.layer_count(), settings, threads).run(output, report);
  if (features) report.features = features->finish();
  warn_of_broken_promises(report, diagnostics);
  warn_of_repairs(report, diagnostics);
  warn_of_losses(report.losses, settings.compensation, diagnostics);
  if (report.layers == 0) throw_empty(report);
  return report;
}

namespace {

// In the plane z = 0.
Box3 box_of(const ldni::Contours& contours) {
  Box3 box;
  box.low.z = box.high.z = 0;
  for (const Vec2& point : contours.points) {
    box.low = glm::min(box.low, Vec3(point, 0));
    box.high = glm::max(box.high, Vec3(point, 0));
  }
  return box;
}

}  // namespace

SliceReport slice_outline(const planar::Region& outline,
                          const Settings& settings, LayerSink& sink,
                          Diagnostics& diagnostics) {
  Layer layer;
  layer.compensation = settings.compensation;
  for (const planar::Contour& contour : outline.contours) {
    auto& [points, ends] = layer.contours;
    points.insert(points.end(), contour.begin(), contour.end());
    ends.push_back(static_cast<std::uint32_t>(points.size()));
  }
  SliceReport report;
  if (settings.min_feature > 0) {
    report.features = find_thin_features(layer, settings.min_feature);
  }
  Compensator compensator(settings.compensation);
  compensator.compensate(layer.contours);
  report.layers = 1;
  report.loops = layer.contours.loop_count();
  report.points = layer.contours.points.size();
  report.losses = compensator.counts();
  warn_of_losses(report.losses, settings.compensation, diagnostics);
  if (layer.contours.is_empty()) throw_empty(report);
  sink.begin(box_of(layer.contours));
  sink.take(layer);
  return report;
}

}  // namespace lamina::slicer
