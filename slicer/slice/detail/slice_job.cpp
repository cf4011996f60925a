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

#include "base/parallel.h"
#include "plane/loop_index.h"
#include "slicer/check/print/layer_overlay.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/layer.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/contour/simplify.h"

namespace lamina::slicer {
namespace {

// A layer on its way through the pipeline, with what was found in it. It gets
// its heights last: layers with equal contours share the rest.
struct Draft {
  Layer layer;
  LayerMeasures measures;
  std::vector<ThinStretch> thin;
  CompensationCounts losses;
  std::string encoded;  // by the sink
};

// Consecutive layers on their way through the pipeline.
struct Block {
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  std::vector<Draft> layers;
  // The overlay of each layer over the one before; the first, and one that
  // repeats, has none.
  std::vector<std::optional<LayerOverlay>> overlays;

  const LayerOverlay* overlay_of(std::uint32_t i) const {
    return i < overlays.size() && overlays[i] ? &*overlays[i] : nullptr;
  }
};

// Copies the contours but for some of their loops; false where these are not
// all among them.
bool take_out(const plane::Contours& contours, const plane::Contours& loops,
              plane::Contours& rest) {
  rest.clear();
  const plane::LoopIndex among(loops);
  std::size_t found = 0;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    if (among.find(loop)) {
      ++found;
    } else {
      rest.add_loop(loop);
    }
  }
  return found == loops.loop_count();
}

// What one thread keeps from block to block.
class Worker {
 public:
  // sink  encodes layers, and takes none
  Worker(const Plans& plans, const ldni::LayerGrid& grid,
         const LayerInsets& insets, const Settings& settings,
         const LayerSink& sink)
      : plans_(plans),
        grid_(grid),
        insets_(insets),
        sink_(sink),
        self_supporting_(settings.print.self_supporting),
        simplifier_(settings.tolerance) {
    if (settings.min_feature > 0) thin_finder_.emplace(settings.min_feature);
    if (makes_whole_print(settings)) overlay_sweep_.emplace();
  }

  // Cuts the leaves.
  void section(Block& block) {
    if (block.layers.size() < block.layer_count) {
      block.layers.resize(block.layer_count);
    }
    // Made in the thread that uses it, for it may open OpenGL.
    if (!slicer_) slicer_ = plans_.whole.make_slicer();
    slicer_->section(block.first_layer, block.layer_count);
    if (plans_.supports) {
      if (!support_slicer_) support_slicer_ = plans_.supports->make_slicer();
      if (!part_slicer_) part_slicer_ = plans_.part->make_slicer();
      support_slicer_->section(block.first_layer, block.layer_count);
      part_slicer_->section(block.first_layer, block.layer_count);
    }
    while (color_slicers_.size() < plans_.colored.size()) {
      const Plan& plan = plans_.colored[color_slicers_.size()].plan;
      color_slicers_.push_back(plan.make_slicer());
    }
    for (const auto& slicer : color_slicers_) {
      slicer->section(block.first_layer, block.layer_count);
    }
    repeats_.assign(block.layer_count, 0);
    for (std::uint32_t i = 0; i < block.layer_count; ++i) {
      const bool repeats =
          slicer_->repeats(i) && has_inset_of_last(block.first_layer + i);
      repeats_[i] = repeats ? 1 : 0;
    }
  }

  void make_contours(Block& block) {
    for_each_new(block, [&](std::uint32_t i, Draft& draft) {
      slicer_->make_contours(i, draft.layer.contours);
      if (support_slicer_) separate_supports(i, draft.layer);
      separate_colors(i, draft.layer);
    });
  }

  // Searches the exact contours, before anything is moved or left out.
  void find_thin_places(Block& block) {
    if (!thin_finder_) return;
    for_each_new(block, [&](std::uint32_t i, Draft& draft) {
      thin_finder_->find(draft.layer.contours, draft.thin);
      slicer_->find_leaves(i, draft.thin);
    });
  }

  // Compensates, and then simplifies, so that arcs lose their vertices too.
  void finish(Block& block) {
    for (std::uint32_t i = 0; i < block.layer_count; ++i) {
      if (repeats_[i] != 0) {
        block.layers[i] = block.layers[i - 1];
      } else {
        finish_draft(block.layers[i], insets_.of(block.first_layer + i));
      }
    }
  }

  // Lays each layer of the block over the one before.
  void lay_over(Block& block) {
    if (!overlay_sweep_) return;
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

  void report_to(SliceReport& report) const {
    if (slicer_) slicer_->report_to(report);
  }

 private:
  // Whether a layer, not the first, is moved as far as the one before.
  bool has_inset_of_last(std::uint32_t layer) const {
    return insets_.of(layer) == insets_.of(layer - 1);
  }

  // Visits the layers that do not repeat the one before.
  template <typename Visit>
  void for_each_new(Block& block, const Visit& visit) {
    for (std::uint32_t i = 0; i < block.layer_count; ++i) {
      if (repeats_[i] == 0) visit(i, block.layers[i]);
    }
  }

  // Where the part is not near a support, the loops of supports are all there
  // is to leave out.
  void separate_supports(std::uint32_t i, Layer& layer) {
    support_slicer_->make_contours(i, layer.supports);
    bool is_near = false;
    for (std::size_t l = 0; l < layer.supports.loop_count() && !is_near; ++l) {
      Box2 box;
      box.add(layer.supports.loop(l));
      is_near = part_slicer_->reaches(i, box);
    }
    if (is_near || !take_out(layer.contours, layer.supports, layer.part)) {
      part_slicer_->make_contours(i, layer.part);
    }
  }

  void separate_colors(std::uint32_t i, Layer& layer) {
    layer.colored.resize(color_slicers_.size());
    for (std::size_t c = 0; c < color_slicers_.size(); ++c) {
      layer.colored[c].color = plans_.colored[c].color;
      color_slicers_[c]->make_contours(i, layer.colored[c].contours);
    }
  }

  // Finishes contours of a share of the layer as those of all of it.
  void finish_share(plane::Contours& contours, double inset) {
    compensate(contours, inset);
    simplifier_.simplify(contours);
  }

  void finish_draft(Draft& draft, double inset) {
    Layer& layer = draft.layer;
    draft.losses = compensate(layer.contours, inset);
    layer.compensation = inset;
    if (support_slicer_) {
      finish_share(layer.part, inset);
      finish_share(layer.supports, inset);
    }
    for (ColoredPart& colored : layer.colored) {
      finish_share(colored.contours, inset);
    }
    simplifier_.simplify(layer.contours);
    layer.clearance = simplifier_.clearance();
    draft.measures = measure(layer.contours);
    draft.encoded.clear();
    if (!layer.contours.is_empty()) draft.encoded = sink_.encode(layer);
  }

  const Plans& plans_;
  const ldni::LayerGrid& grid_;
  const LayerInsets& insets_;
  const LayerSink& sink_;
  const double self_supporting_;
  std::unique_ptr<BlockSlicer> slicer_;
  // If there are supports.
  std::unique_ptr<BlockSlicer> support_slicer_;
  std::unique_ptr<BlockSlicer> part_slicer_;
  std::vector<std::unique_ptr<BlockSlicer>> color_slicers_;  // as the plans
  std::optional<ThinFinder> thin_finder_;  // if thin places are searched for
  std::optional<OverlaySweep> overlay_sweep_;  // if there is a layer graph
  Simplifier simplifier_;
  std::vector<std::uint8_t> repeats_;  // of the block's layers
};

// Deals out the blocks of a job, first to last, and hands their layers on in
// order.
class Job {
 public:
  Job(const Plan& plan, const ldni::LayerGrid& grid, const Settings& settings,
      LayerSink& sink, const Checks& checks, SliceReport& report)
      : grid_(grid),
        block_count_(plan.blocks.count(grid.layer_count())),
        keeps_empty_(!settings.heights.empty()),
        wanted_(settings.written),
        sink_(sink),
        checks_(checks),
        report_(report) {
    empty_.layer.compensation = settings.compensation;
  }

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

  // Writes the layers of the next block.
  void write(Block& block) {
    leaving_.clear();
    for (std::uint32_t i = 0; i < block.layer_count; ++i) {
      add(block.first_layer + i, block.layers[i], block.overlay_of(i));
    }
    for_each_leaving([&](const Layer& layer, const Leaving& leaving) {
      report_.add(leaving.draft->measures, layer.bottom, layer.top);
      sink_.take_encoded(layer, leaving.draft->encoded);
    });
  }

  // These look at the layers that were written last.
  void collect_features() {
    if (checks_.features == nullptr) return;
    for_each_leaving([&](const Layer& layer, const Leaving& leaving) {
      checks_.features->take(layer, leaving.draft->thin);
    });
  }
  void extend_graph() {
    if (checks_.graph == nullptr) return;
    for_each_leaving([&](const Layer& layer, const Leaving& leaving) {
      checks_.graph->take(layer, leaving.overlay);
    });
  }
  void measure_supports() {
    if (checks_.supports == nullptr) return;
    for_each_leaving([&](const Layer& layer, const Leaving&) {
      checks_.supports->take(layer);
    });
  }

 private:
  // A layer that is written, or several empty ones.
  struct Leaving {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    Draft* draft = nullptr;
    const LayerOverlay* overlay = nullptr;  // over the one before, if known
  };

  std::uint32_t border(std::uint32_t block) const {
    return static_cast<std::uint32_t>(std::uint64_t{grid_.layer_count()} *
                                      block / block_count_);
  }

  // Empty layers wait for one that is not.
  void add(std::uint32_t index, Draft& draft, const LayerOverlay* overlay) {
    report_.losses += draft.losses;
    if (draft.layer.contours.is_empty() && !keeps_empty_) {
      if (report_.layers_there > 0) ++held_back_;
      return;
    }
    for (; held_back_ > 0; --held_back_) {
      leave(index - held_back_, empty_, nullptr);
    }
    leave(index, draft, overlay);
  }

  void leave(std::uint32_t index, Draft& draft, const LayerOverlay* overlay) {
    if (!wanted_.contains(++report_.layers_there)) return;
    if (leaving_.empty() || leaving_.back().draft != &draft) {
      leaving_.push_back({index, 0, &draft, overlay});
    }
    ++leaving_.back().count;
  }

  template <typename Visit>
  void for_each_leaving(const Visit& visit) const {
    for (const Leaving& leaving : leaving_) {
      Layer& layer = leaving.draft->layer;
      for (std::uint32_t i = 0; i < leaving.count; ++i) {
        const std::uint32_t index = leaving.first + i;
        layer.section_z = grid_.section_z(index);
        layer.bottom = grid_.layer_bottom(index);
        layer.top = grid_.layer_top(index);
        visit(layer, leaving);
      }
    }
  }

  const ldni::LayerGrid& grid_;
  const std::uint32_t block_count_;
  const bool keeps_empty_;
  const LayerNumbers wanted_;
  LayerSink& sink_;
  const Checks checks_;
  SliceReport& report_;
  std::uint32_t started_ = 0;
  std::uint32_t held_back_ = 0;
  std::vector<Leaving> leaving_;  // of the block
  Draft empty_;
};

// No thread is without a block.
unsigned choose_threads(const Settings& settings, std::uint32_t block_count) {
  const unsigned wanted = settings.threads != 0
                              ? settings.threads
                              : std::thread::hardware_concurrency();
  return std::max(1U, std::min(wanted, block_count));
}

}  // namespace

void run_slice_job(const Plans& plans, const ldni::LayerGrid& grid,
                   const LayerInsets& insets, const Settings& settings,
                   LayerSink& sink, const Checks& checks, SliceReport& report) {
  Job job(plans.whole, grid, settings, sink, checks, report);
  const Road<Block, Worker> road = {
      .start = [&](Block& block) { return job.start(block); },
      .make_worker =
          [&] {
            return std::make_unique<Worker>(plans, grid, insets, settings,
                                            sink);
          },
      .work = {{report.section_seconds, &Worker::section},
               {report.sweep_seconds, &Worker::make_contours},
               {report.feature_seconds, &Worker::find_thin_places},
               {report.output_seconds, &Worker::finish},
               {report.graph_seconds, &Worker::lay_over}},
      .finish =
          {{report.output_seconds, [&](Block& block) { job.write(block); }},
           {report.feature_seconds, [&](Block&) { job.collect_features(); }},
           {report.graph_seconds, [&](Block&) { job.extend_graph(); }},
           {report.graph_seconds, [&](Block&) { job.measure_supports(); }}}};
  const unsigned threads = choose_threads(settings, job.block_count());
  for (const auto& worker :
       run_pipeline(road, threads, settings.threads != 0)) {
    worker->report_to(report);
  }
}

}  // namespace lamina::slicer
