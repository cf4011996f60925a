#include "slicer/check/inspect.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "slicer/check/defects.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/formats/output_format.h"

namespace lamina::slicer {
namespace {

constexpr std::size_t kToldDefects = 20;

// As an SLC file holds it: the first point again at the end of each loop.
SlcLayer close_loops(const Layer& layer) {
  SlcLayer closed;
  closed.z = layer.bottom;
  closed.thickness = layer.top - layer.bottom;
  for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
    const auto loop = layer.contours.loop(i);
    SlcBoundary& boundary = closed.boundaries.emplace_back();
    boundary.points.assign(loop.begin(), loop.end());
    if (!loop.empty()) boundary.points.push_back(loop.front());
  }
  return closed;
}

}  // namespace

Inspector::Inspector(double min_feature) {
  found_.min_feature = min_feature;
  if (min_feature > 0) {
    finder_.emplace(min_feature);
    collector_.emplace(min_feature, std::vector<std::uint32_t>{});
  }
}

void Inspector::add_defect(std::string words) {
  if (++found_.defects <= kToldDefects) {
    found_.told_defects.push_back(std::move(words));
  }
}

void Inspector::take(const Layer& layer) { take(layer, close_loops(layer)); }

void Inspector::take(const Layer& layer, const SlcLayer& boundaries) {
  const std::size_t number = found_.layers.size() + 1;
  if (number > 1 && !(layer.bottom > found_.layers.back().bottom)) {
    add_defect(fmt::format("layer {} at z {}: not higher than the layer before",
                           number, layer.bottom));
  }
  for (const Defect& defect : find_defects(boundaries)) {
    add_defect(fmt::format("layer {} at z {}: loop {} {}, near x {} y {}",
                           number, layer.bottom, defect.boundary + 1,
                           describe(defect.kind), defect.place.x,
                           defect.place.y));
  }
  for (const Vec2& point : layer.contours.points) {
    found_.box.low = glm::min(found_.box.low, Vec3(point, layer.bottom));
    found_.box.high = glm::max(found_.box.high, Vec3(point, layer.top));
  }
  found_.greatest_coordinate =
      std::max(found_.greatest_coordinate,
               ldni::greatest_coordinate(layer.contours.points));
  found_.layers.push_back(
      {layer.bottom, layer.top - layer.bottom, measure(layer.contours)});
  found_.volume +=
      found_.layers.back().measures.area * found_.layers.back().thickness;
  found_.top = layer.top;
  if (!finder_) return;
  finder_->find(layer.contours, stretches_);
  collector_->take(layer, stretches_);
}

Inspection Inspector::finish() {
  if (collector_) found_.features = collector_->finish();
  return std::move(found_);
}

namespace {

void describe_header(const SlcReader& reader, Inspection& found) {
  const SlcHeader& header = reader.header();
  found.format = "SLC " + header.version;
  found.writer = header.package;
  found.header = fmt::format("{}, unit {}", header.type, header.unit);
  found.extents = header.extents;
  found.sampling = reader.sampling();
  found.deviation = header.deviation;
}

}  // namespace

Inspection inspect_file(const std::string& path, double min_feature,
                        const FileAccess& access) {
  Inspector inspector(min_feature);
  Inspection& found = inspector.found_;
  found.name = path;
  if (is_named(path, ".slc")) {
    // Its boundaries as they are: they may be open.
    SlcReader reader(path, access);
    describe_header(reader, found);
    SlcLayer slc_layer;
    while (reader.read_layer(slc_layer)) {
      const Layer layer = to_layer(slc_layer);
      require_within_reach(path, layer, found.layers.size() + 1);
      inspector.take(layer, slc_layer);
    }
    found.top = reader.top();
    if (!found.layers.empty() && found.top < found.layers.back().bottom) {
      inspector.add_defect(fmt::format(
          "the end record's top, z {}, lies below the last layer", found.top));
    }
    return inspector.finish();
  }
  const LayerFileFacts facts = read_layers(
      path, [&](Layer& layer) { inspector.take(layer); }, access);
  found.format = facts.format;
  found.writer = facts.writer;
  found.deviation = facts.deviation;
  found.is_float32 = facts.is_float32;
  found.has_sides = facts.has_sides;
  found.lines_left_out = facts.lines_left_out;
  return inspector.finish();
}

}  // namespace lamina::slicer
