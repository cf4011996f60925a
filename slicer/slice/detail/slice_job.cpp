#include "slicer/slice/detail/slice_job.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>

#include "base/parallel.h"
#include "base/thread_clock.h"
#include "slicer/check/print/layer_overlay.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/contour/simplify.h"

namespace lamina::slicer {
namespace {

namespace tbb = oneapi::tbb;

// Blocks in flight for each thread: one in work, one that waits to be written.
constexpr std::size_t kBlocksPerThread = 2;

// A layer that passes through the pipeline, with what was found in it. It gets
// its heights last: layers with equal contours share the rest.
struct Draft {
  Layer layer;
  LayerMeasures measures;
  std::vector<ThinStretch> thin;
  CompensationCounts losses;
};

// Consecutive layers that pass through the pipeline. Blocks are reused, so
// that the steady state allocates nothing.
struct Block {
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  std::vector<Draft> layers;
  // The overlay of each layer over the one before; the first, and one that
  // repeats, has none.
  std::vector<std::optional<LayerOverlay>> overlays;
  double section_seconds = 0;
  double sweep_seconds = 0;
  double feature_seconds = 0;
  double graph_seconds = 0;
  double finish_seconds = 0;  // compensation, simplification, encoding

  const LayerOverlay* overlay_of(std::uint32_t i) const {
    return i < overlays.size() && overlays[i] ? &*overlays[i] : nullptr;
  }
};

// What one thread keeps from block to block.
class Worker {
 public:
  // sink  encodes layers, and takes none
  Worker(const Plan& plan, const ldni::LayerGrid& grid,
         const Settings& settings, const LayerSink& sink)
      : plan_(plan),
        grid_(grid),
        sink_(sink),
        self_supporting_(settings.self_supporting),
        compensation_(settings.compensation),
        simplifier_(settings.tolerance) {
    if (settings.min_feature > 0) thin_finder_.emplace(settings.min_feature);
    if (makes_whole_print(settings)) overlay_sweep_.emplace();
  }

  void make_contours(Block& block) {
    if (block.layers.size() < block.layer_count) {
      block.layers.resize(block.layer_count);
    }
    const std::span<Draft> layers(block.layers.data(), block.layer_count);
    block.section_seconds = measure_seconds([&] {
      // Made in the thread that uses it, for it may open OpenGL.
      if (!slicer_) slicer_ = plan_.make_slicer();
      slicer_->section(block.first_layer, block.layer_count);
    });
    repeats_.assign(block.layer_count, 0);
    block.sweep_seconds = measure_seconds([&] {
      for (std::uint32_t i = 0; i < block.layer_count; ++i) {
        repeats_[i] = slicer_->repeats(i) ? 1 : 0;
        if (repeats_[i] == 0) {
          slicer_->make_contours(i, layers[i].layer.contours);
        }
      }
    });
    // Search the exact contours, before anything is moved or left out.
    if (thin_finder_) {
      block.feature_seconds = measure_seconds([&] {
        for (std::uint32_t i = 0; i < block.layer_count; ++i) {
          if (repeats_[i] != 0) continue;
          thin_finder_->find(layers[i].layer.contours, layers[i].thin);
          slicer_->find_leaves(i, layers[i].thin);
        }
      });
    }
    // Simplify last, so that arcs lose their vertices too.
    block.finish_seconds = measure_seconds([&] {
      for (std::uint32_t i = 0; i < block.layer_count; ++i) {
        if (repeats_[i] != 0) {
          layers[i] = layers[i - 1];
        } else {
          finish(layers[i]);
        }
      }
    });
    if (overlay_sweep_) {
      block.graph_seconds = measure_seconds([&] { lay_over(block); });
    }
  }

  void report_to(SliceReport& report) const {
    if (slicer_) slicer_->report_to(report);
  }

 private:
  // Lays each layer of the block over the one before.
  void lay_over(Block& block) {
    block.overlays.resize(block.layers.size());
    overlay_sweep_->start(block.layers[0].layer.contours);
    for (std::uint32_t i = 0; i < block.layer_count; ++i) {
      std::optional<LayerOverlay>& overlay = block.overlays[i];
      if (i == 0 || repeats_[i] != 0) {
        overlay.reset();
        continue;
      }
      if (!overlay) overlay.emplace();
      const std::uint32_t number = block.first_layer + i;
      const double rise = grid_.section_z(number) - grid_.section_z(number - 1);
      overlay_sweep_->lay_over(block.layers[i].layer.contours,
                               reach_of(self_supporting_, rise), *overlay);
    }
  }

  void finish(Draft& draft) {
    Layer& layer = draft.layer;
    draft.losses = compensate(layer.contours, compensation_);
    layer.compensation = compensation_;
    simplifier_.simplify(layer.contours);
    layer.clearance = simplifier_.clearance();
    draft.measures = measure(layer.contours);
    layer.encoded.clear();
    if (!layer.contours.is_empty()) layer.encoded = sink_.encode(layer);
  }

  const Plan& plan_;
  const ldni::LayerGrid& grid_;
  const LayerSink& sink_;
  const double self_supporting_;
  const double compensation_;
  std::unique_ptr<BlockSlicer> slicer_;
  std::optional<ThinFinder> thin_finder_;  // if thin places are searched for
  std::optional<OverlaySweep> overlay_sweep_;  // if there is a layer graph
  Simplifier simplifier_;
  std::vector<std::uint8_t> repeats_;  // of the block's layers
};

// What checks have taken so far, by the clock on the wall [s].
struct CheckSeconds {
  double features = 0;
  double graph = 0;
};

// Hands layers on in order.
class OrderedOutput {
 public:
  OrderedOutput(const ldni::LayerGrid& grid, const Settings& settings,
                LayerSink& sink, const Checks& checks, SliceReport& report)
      : grid_(grid),
        keeps_empty_(!settings.heights.empty()),
        wanted_(settings.written),
        sink_(sink),
        checks_(checks),
        report_(report) {
    empty_.layer.compensation = settings.compensation;
  }

  // overlay  of the layer over the one before; null where it is not known
  void take(std::uint32_t index, Draft& draft, const LayerOverlay* overlay) {
    report_.losses += draft.losses;
    if (draft.layer.contours.is_empty() && !keeps_empty_) {
      if (report_.layers_there > 0) ++held_back_;
      return;
    }
    for (; held_back_ > 0; --held_back_) {
      emit(index - held_back_, empty_, nullptr);
    }
    emit(index, draft, overlay);
  }

  // Since the last call.
  CheckSeconds take_check_seconds() {
    return std::exchange(check_seconds_, {});
  }

 private:
  void emit(std::uint32_t index, Draft& draft, const LayerOverlay* overlay) {
    if (!wanted_.contains(++report_.layers_there)) return;
    Layer& layer = draft.layer;
    layer.section_z = grid_.section_z(index);
    layer.bottom = grid_.layer_bottom(index);
    layer.top = grid_.layer_top(index);
    report_.add(draft.measures, layer.bottom, layer.top);
    sink_.take(layer);
    if (checks_.features != nullptr) {
      check_seconds_.features += measure_wall_seconds(
          [&] { checks_.features->take(layer, draft.thin); });
    }
    if (checks_.graph != nullptr) {
      check_seconds_.graph +=
          measure_wall_seconds([&] { checks_.graph->take(layer, overlay); });
    }
  }

  const ldni::LayerGrid& grid_;
  bool keeps_empty_;
  LayerNumbers wanted_;
  LayerSink& sink_;
  const Checks checks_;
  SliceReport& report_;
  CheckSeconds check_seconds_;
  std::uint32_t held_back_ = 0;
  Draft empty_;
};

// Deals out the blocks of a job, first to last, and takes them back.
class Job {
 public:
  Job(const Plan& plan, std::uint32_t layer_count, OrderedOutput& output,
      SliceReport& report)
      : layer_count_(layer_count),
        block_count_(plan.blocks.count(layer_count)),
        output_(output),
        report_(report) {}

  std::uint32_t block_count() const { return block_count_; }

  // Begins the next block; false after the last one. Blocks are as equal as can
  // be, and their borders depend on the job alone.
  bool start(Block& block) {
    if (started_ == block_count_) return false;
    block.first_layer = border(started_);
    block.layer_count = border(started_ + 1) - block.first_layer;
    ++started_;
    return true;
  }

  void hand_on(Block& block) {
    report_.section_seconds += block.section_seconds;
    report_.sweep_seconds += block.sweep_seconds;
    report_.feature_seconds += block.feature_seconds;
    report_.graph_seconds += block.graph_seconds;
    double wall_seconds = 0;
    const double seconds = measure_seconds([&] {
      wall_seconds = measure_wall_seconds([&] {
        for (std::uint32_t i = 0; i < block.layer_count; ++i) {
          output_.take(block.first_layer + i, block.layers[i],
                       block.overlay_of(i));
        }
      });
    });
    const CheckSeconds checks = output_.take_check_seconds();
    const double share = wall_seconds > 0 ? seconds / wall_seconds : 0;
    report_.feature_seconds += share * checks.features;
    report_.graph_seconds += share * checks.graph;
    report_.output_seconds += block.finish_seconds + seconds -
                              share * (checks.features + checks.graph);
  }

 private:
  std::uint32_t border(std::uint32_t block) const {
    return static_cast<std::uint32_t>(std::uint64_t{layer_count_} * block /
                                      block_count_);
  }

  std::uint32_t layer_count_;
  std::uint32_t block_count_;
  std::uint32_t started_ = 0;
  OrderedOutput& output_;
  SliceReport& report_;
};

using MakeWorker = std::function<Worker()>;

// Does without the library of tasks, whose start takes as long as a small
// design.
void run_alone(Job& job, const MakeWorker& make_worker, SliceReport& report) {
  Worker worker = make_worker();
  Block block;
  while (job.start(block)) {
    worker.make_contours(block);
    job.hand_on(block);
  }
  worker.report_to(report);
}

// is_limited  whether no more threads may work, nor fewer than asked for
void run_together(Job& job, unsigned threads, bool is_limited,
                  const MakeWorker& make_worker, SliceReport& report) {
  // Where nobody says how many there are to be, the blocks under way say it.
  // (oneTBB 2021.8 hangs in this where memory ends while threads start.)
  std::optional<tbb::global_control> limit;
  if (is_limited) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }
  tbb::enumerable_thread_specific<Worker> workers(make_worker);
  std::vector<Block> blocks(kBlocksPerThread * threads);
  // Input and output keep the same order and at most blocks.size() blocks are
  // under way, so the oldest block's memory is free again.
  Stages stages;
  stages.start = [&](std::size_t place) {
    const TaskTurn turn(&job);
    const TaskTurn block_turn(&blocks[place]);
    return job.start(blocks[place]);
  };
  stages.work = [&](std::size_t place) {
    const TaskTurn turn(&blocks[place]);
    workers.local().make_contours(blocks[place]);
  };
  stages.finish = [&](std::size_t place) {
    const TaskTurn turn(&report);
    const TaskTurn block_turn(&blocks[place]);
    job.hand_on(blocks[place]);
  };
  {
    const Lent lent_job(&job);
    const Lent lent_report(&report);
    run_pipeline(blocks.size(), stages);
  }
  for (const Worker& worker : workers) worker.report_to(report);
}

// No thread is without a block.
unsigned choose_threads(const Settings& settings, std::uint32_t block_count) {
  const unsigned wanted = settings.threads != 0
                              ? settings.threads
                              : std::thread::hardware_concurrency();
  return std::max(1U, std::min(wanted, block_count));
}

}  // namespace

void run_slice_job(const Plan& plan, const ldni::LayerGrid& grid,
                   const Settings& settings, LayerSink& sink,
                   const Checks& checks, SliceReport& report) {
  OrderedOutput output(grid, settings, sink, checks, report);
  Job job(plan, grid.layer_count(), output, report);
  const unsigned threads = choose_threads(settings, job.block_count());
  const auto make_worker = [&] { return Worker(plan, grid, settings, sink); };
  if (threads == 1) {
    run_alone(job, make_worker, report);
  } else {
    run_together(job, threads, settings.threads != 0, make_worker, report);
  }
}

}  // namespace lamina::slicer
