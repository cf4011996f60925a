#include "slicer/dump/layer_dump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/diagnostic.h"
#include "slicer/dump/detail/stage_items.h"

namespace lamina::slicer {
namespace {

// Shares of the greater side of a drawing.
constexpr double kMargin = 0.03;
constexpr double kThinLine = 0.002;
constexpr double kMarkRadius = 0.006;

// The layer that holds the height: [bottom, top).
std::uint32_t layer_at(const ldni::LayerGrid& grid, double z) {
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < grid.layer_count(); ++i) {
    const double distance =
        std::max({grid.layer_bottom(i) - z, z - grid.layer_top(i), 0.0});
    if (distance > least) break;
    least = distance;
    nearest = i;
  }
  if (least > 0) {
    throw GeometryError(
        fmt::format("No layer is at height {:.10g}; the nearest reaches from "
                    "{:.10g} to {:.10g}.",
                    z, grid.layer_bottom(nearest), grid.layer_top(nearest)));
  }
  return nearest;
}

std::string text_of(const std::string& title,
                    const std::vector<DumpItem>& items) {
  std::string text = title + '\n';
  for (const DumpItem& item : items) {
    text += item.text + '\n';
    if (item.shape != DumpShape::kLine) continue;
    for (const Vec2& point : item.points) {
      text += fmt::format("    {} {}\n", point.x, point.y);
    }
  }
  return text;
}

// A leaf has the same colour in all drawings of a design; neighbours differ by
// the golden angle.
std::string colour_of(std::uint32_t instance) {
  return fmt::format("hsl({:.0f},75%,40%)", std::fmod(137.508 * instance, 360));
}

std::string points_text(std::span<const Vec2> points) {
  std::string text;
  for (const Vec2& point : points) {
    text += fmt::format("{},{} ", point.x, point.y);
  }
  return text;
}

template <typename Value>
void set(pugi::xml_node node, const char* name, const Value& value) {
  node.append_attribute(name).set_value(fmt::format("{}", value).c_str());
}

pugi::xml_node add_shape(pugi::xml_node group, const char* name,
                         const DumpItem& item) {
  pugi::xml_node node = group.append_child(name);
  set(node, "stroke", colour_of(item.instance));
  node.append_child("title").text().set(item.text.c_str());
  return node;
}

// side  the greater one of the drawing [mm]
void draw_marks(pugi::xml_node group, const DumpItem& item, double side) {
  for (const Vec2& point : item.points) {
    pugi::xml_node mark = add_shape(group, "circle", item);
    set(mark, "cx", point.x);
    set(mark, "cy", point.y);
    set(mark, "r", kMarkRadius * side);
    set(mark, "pointer-events", "all");
  }
}

void draw_line(pugi::xml_node group, const DumpItem& item, double side) {
  pugi::xml_node line = add_shape(group, "polyline", item);
  set(line, "points", points_text(item.points));
  if (item.shape == DumpShape::kLine) return;
  set(line, "stroke-dasharray", 4 * kThinLine * side);
}

// Draws the items over the filled contours. A group turns y upwards.
std::string drawing_of(const std::string& title,
                       const plane::Contours& contours,
                       const std::vector<DumpItem>& items) {
  Box2 box;
  for (const DumpItem& item : items) box.add(std::span(item.points));
  std::string path;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    path += fmt::format("M{}Z", points_text(contours.loop(i)));
  }
  if (box.is_empty()) box.add(Vec2(0));
  const double side = std::max({box.size().x, box.size().y, 1e-6});
  const Vec2 low = box.low - Vec2(kMargin * side);
  const Vec2 high = box.high + Vec2(kMargin * side);

  pugi::xml_document document;
  pugi::xml_node svg = document.append_child("svg");
  set(svg, "xmlns", "http://www.w3.org/2000/svg");
  set(svg, "viewBox",
      fmt::format("{} {} {} {}", low.x, -high.y, high.x - low.x,
                  high.y - low.y));
  svg.append_child("title").text().set(title.c_str());
  pugi::xml_node group = svg.append_child("g");
  set(group, "transform", "scale(1,-1)");
  set(group, "fill", "none");
  set(group, "stroke-width", kThinLine * side);
  pugi::xml_node solid = group.append_child("path");
  set(solid, "fill", "#ddd");
  set(solid, "d", path);
  for (const DumpItem& item : items) {
    if (item.shape == DumpShape::kNone) continue;
    const auto draw = item.shape == DumpShape::kMarks ? draw_marks : draw_line;
    draw(group, item, side);
  }
  std::ostringstream stream;
  document.save(stream, "");
  return stream.str();
}

}  // namespace

std::string dump_layer(const csg::Scene& scene, const ldni::LayerGrid& grid,
                       const DumpRequest& request) {
  const std::uint32_t number = layer_at(grid, request.z);
  const DumpedLayer layer(scene, grid, number, request.line_of);
  const std::string title = fmt::format(
      "{}: section at height {:.10g} of the layer from {:.10g} to {:.10g}",
      kDumpStages[static_cast<std::size_t>(request.stage)],
      grid.section_z(number), grid.layer_bottom(number),
      grid.layer_top(number));
  std::vector<DumpItem> items = stage_items(layer, request.stage);
  if (!request.is_drawing) return text_of(title, items);
  if (request.stage == DumpStage::kScene ||
      request.stage == DumpStage::kEvents) {
    const std::vector<DumpItem> chains = stage_items(layer, DumpStage::kChains);
    items.insert(items.begin(), chains.begin(), chains.end());
  }
  return drawing_of(title, layer.contours, items);
}

}  // namespace lamina::slicer
