#include "slicer/check/defects/inspect.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plane/loop_area.h"
#include "slicer/check/defects/defects.h"

namespace lamina::slicer {
namespace {

constexpr std::size_t kReportedDefects = 20;

}  // namespace

Inspector::Inspector(const InspectOptions& options)
    : finds_defects_(options.finds_defects) {
  found_.min_feature = options.min_feature;
  if (options.min_feature > 0) {
    finder_.emplace(options.min_feature);
    collector_.emplace(options.min_feature, std::vector<std::uint32_t>{});
  }
  if (options.makes_graph) graph_.emplace(options.print);
}

void Inspector::add_defect(std::string words) {
  if (++found_.defects <= kReportedDefects) {
    found_.reported_defects.push_back(std::move(words));
  }
}

// Adds a defect for each loop; of the first one it says where it is.
void Inspector::add_faulty_loops(const FaultyLoops& loops,
                                 std::string_view fault) {
  if (loops.count == 0) return;
  const std::string more =
      loops.count > 1 ? fmt::format(" (the first of {})", loops.count) : "";
  add_defect(fmt::format("layer {} at z {}: a loop {}, near x {} y {}{}",
                         loops.layer, found_.layers.at(loops.layer - 1).bottom,
                         fault, loops.place.x, loops.place.y, more));
  found_.defects += loops.count - 1;
}

// Layers without thickness are sections.
void Inspector::check_heights(const Layer& layer) {
  const auto add = [&](const std::string& words) {
    add_defect(fmt::format("layer {} at z {}: {}", found_.layers.size() + 1,
                           layer.bottom, words));
  };
  const bool is_first = found_.layers.empty();
  if (!is_first && !(layer.bottom > found_.layers.back().bottom)) {
    add("not higher than the layer before");
  } else if (layer.top < layer.bottom ||
             (layer.top == layer.bottom && !is_first &&
              found_.layers.front().thickness > 0)) {
    add(fmt::format("its thickness, {:.6g} mm, is not positive",
                    layer.top - layer.bottom));
  } else if (!is_first) {
    const double gap = gap_between(found_.layers.back().bottom, found_.top,
                                   layer.bottom, layer.top);
    if (gap > 0) {
      add(fmt::format("begins {:.6g} mm above the end of the layer before",
                      gap));
    } else if (gap < 0) {
      add(fmt::format("overlaps the layer before by {:.6g} mm", -gap));
    }
  }
}

void Inspector::add_loop_defects(const Layer& layer,
                                 std::span<const WrittenLoop> loops) {
  const std::size_t number = found_.layers.size() + 1;
  for (const Defect& defect : find_defects(loops)) {
    add_defect(fmt::format("layer {} at z {}: loop {} {}, near x {} y {}",
                           number, layer.bottom, defect.loop + 1,
                           describe(defect.kind), defect.place.x,
                           defect.place.y));
  }
}

void Inspector::take(const Layer& layer) {
  take(layer, finds_defects_ ? closed_loops(layer.contours)
                             : std::vector<WrittenLoop>());
}

void Inspector::take(const Layer& layer, std::span<const WrittenLoop> loops) {
  check_heights(layer);
  if (finds_defects_) add_loop_defects(layer, loops);
  for (const Vec2& point : layer.contours.points) {
    found_.box.add(Box3{Vec3(point, layer.bottom), Vec3(point, layer.top)});
  }
  found_.greatest_coordinate = std::max(
      found_.greatest_coordinate, greatest_coordinate(layer.contours.points));
  found_.layers.push_back({layer.bottom, layer.top - layer.bottom,
                           measure(layer.contours),
                           total_perimeter(layer.contours)});
  found_.volume +=
      found_.layers.back().measures.area * found_.layers.back().thickness;
  found_.top = layer.top;
  if (graph_) graph_->take(layer, nullptr);
  if (!finder_) return;
  finder_->find(layer.contours, stretches_);
  collector_->take(layer, stretches_);
}

Inspection Inspector::finish(std::string name, LayerFileFacts file) {
  found_.name = std::move(name);
  found_.file = std::move(file);
  if (found_.file.top) {
    found_.top = *found_.file.top;
    if (!found_.layers.empty() && found_.top < found_.layers.back().bottom) {
      add_defect(fmt::format(
          "the end record's top, z {}, lies below the last layer", found_.top));
    }
  }
  add_faulty_loops(found_.file.open_loops, "is not closed in the file");
  add_faulty_loops(found_.file.short_loops, "has fewer than 3 points");
  if (collector_) found_.features = collector_->finish();
  if (graph_) found_.print = graph_->finish();
  return std::move(found_);
}

}  // namespace lamina::slicer
