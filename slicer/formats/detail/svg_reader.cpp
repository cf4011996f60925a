// Reads layers from SVG files in the layout of Slic3r (docs/formats.md): a
// group with slic3r:z for each layer, polygons of type contour and hole in it.
//
// Slic3r's own files differ from lamina's: y runs upwards there, coordinates
// begin at the lower left corner of the part, and version 1.3 writes heights in
// a millionth of millimetres.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/file/length_units.h"
#include "base/file/xml.h"
#include "base/text.h"
#include "slicer/formats/detail/reading.h"

namespace lamina::slicer {
namespace {

// What Slic3r 1.3 writes for a height of 1 mm. Heights below the greatest are
// taken for its heights.
constexpr double kSlic3rHeightsPerMm = 1e-6;
constexpr double kGreatestSlic3rHeight = 0.001;

class SvgReader {
 public:
  SvgReader(const std::string& path, const FileAccess& access)
      : path_(path), file_(read_whole(path, access)) {
    const auto fault =
        load_xml(file_, document_, pugi::parse_default | pugi::parse_comments);
    if (fault) {
      fail_to_read(path,
                   fmt::format("line {}: {}", line_at(file_, fault->place),
                               fault->words));
    }
    root_ = document_.child("svg");
    if (!root_) fail_to_read(path, "not an SVG file: it has no element <svg>");
  }

  LayerFileFacts read(const TakeLayer& take) {
    find_writer();
    find_scale();
    find_layers();
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      Layer layer;
      set_heights(layer, i);
      for (const pugi::xml_node node : groups_[i].children()) {
        if (node.type() == pugi::node_element) take_element(node, layer, i + 1);
      }
      take(layer);
    }
    facts_.format = "SVG";
    facts_.has_sides = false;
    return facts_;
  }

 private:
  [[noreturn]] void fail(const pugi::xml_node& node,
                         std::string_view message) const {
    const auto place = static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    fail_to_read(path_,
                 fmt::format("line {}: {}", line_at(file_, place), message));
  }

  // Both programs name themselves in a comment.
  void find_writer() {
    for (const pugi::xml_node node : root_.children()) {
      if (node.type() != pugi::node_comment) continue;
      std::string_view text = node.value();
      const std::size_t slic3r = text.find("Slic3r");
      const std::size_t lamina = text.find("lamina ");
      is_slic3r_ = slic3r != std::string_view::npos;
      const std::size_t name = is_slic3r_ ? slic3r : lamina;
      if (name == std::string_view::npos) continue;
      text = text.substr(name);
      text = text.substr(0, text.find('\n'));
      while (text.ends_with(' ')) text.remove_suffix(1);
      facts_.writer = text;
      return;
    }
  }

  // Returns the millimetres of a length as SVG writes it; without a unit it is
  // in millimetres, as Slic3r has it.
  std::optional<double> length(const char* attribute) const {
    std::string_view text = root_.attribute(attribute).value();
    double value = 0;
    if (!take_number(text, value)) return std::nullopt;
    if (text == "in") return value * kMillimetresPerInch;
    if (text == "cm") return value * 10;
    if (text == "mm" || text.empty()) return value;
    return std::nullopt;
  }

  void find_scale() {
    std::string_view box = root_.attribute("viewBox").value();
    double width = 0;
    bool has_box = true;
    // The width is the third number, behind the corner's two.
    for (int i = 0; has_box && i < 3; ++i) {
      skip(box, ", ");
      has_box = take_number(box, width);
    }
    const std::optional<double> printed = length("width");
    if (has_box && printed && width > 0 && *printed > 0) {
      mm_per_unit_ = *printed / width;
    }
  }

  void find_layers() {
    double greatest = 0;
    for (const pugi::xml_node group : root_.children()) {
      const pugi::xml_attribute attribute = group.attribute("slic3r:z");
      if (!attribute) {
        count_beside_layers(group);
        continue;
      }
      std::string_view text = attribute.value();
      double z = 0;
      if (!take_number(text, z) || !text.empty()) {
        fail(group, "slic3r:z is not a number");
      }
      if (group.attribute("transform")) {
        fail(group, "a layer with a transform is not supported");
      }
      greatest = std::max(greatest, std::abs(z));
      groups_.push_back(group);
      heights_.push_back(z);
    }
    if (groups_.empty()) {
      fail_to_read(path_,
                   "no layers: no group has slic3r:z, as Slic3r writes them");
    }
    if (!is_slic3r_ || greatest >= kGreatestSlic3rHeight) return;
    for (double& z : heights_) z /= kSlic3rHeightsPerMm;
  }

  // What is drawn beside the layers is left out. What cannot be drawn is none
  // of the print's: texts about the file, and elements of other namespaces.
  void count_beside_layers(const pugi::xml_node& node) {
    constexpr std::array<std::string_view, 5> kTexts = {
        "title", "desc", "metadata", "defs", "style"};
    const std::string_view name = node.name();
    if (node.type() != pugi::node_element ||
        name.find(':') != std::string_view::npos ||
        std::ranges::find(kTexts, name) != kTexts.end()) {
      return;
    }
    if (const auto layer = node.find_node([](const pugi::xml_node& inner) {
          return !inner.attribute("slic3r:z").empty();
        })) {
      fail(layer, "a layer within another element is not supported");
    }
    ++facts_.left_out[short_name(fmt::format("{} element", name))];
  }

  void set_heights(Layer& layer, std::size_t i) const {
    const double z = heights_[i];
    layer.section_z = z;
    const bool is_first = i == 0;
    const bool is_last = i + 1 == heights_.size();
    const double below = is_first ? 0 : (z - heights_[i - 1]) / 2;
    const double above = is_last ? below : (heights_[i + 1] - z) / 2;
    layer.bottom = z - (is_first ? above : below);
    layer.top = z + above;
  }

  // number  the layer's, from 1
  void take_element(const pugi::xml_node& node, Layer& layer,
                    std::size_t number) {
    const std::string_view name = node.name();
    const std::string_view type = node.attribute("slic3r:type").value();
    const bool is_contour = type == "contour";
    if (node.attribute("transform")) {
      fail(node, "a transform within a layer is not supported");
    }
    if (name != "polygon" || (!is_contour && type != "hole")) {
      if (name == "polygon" && type.empty()) {
        fail(node, "a polygon without slic3r:type");
      }
      ++facts_.left_out[short_name(name == "polygon"
                                       ? fmt::format("{} polygon", type)
                                       : fmt::format("{} element", name))];
      return;
    }
    read_points(node);
    add_loop(points_, is_contour ? LoopKind::kOuter : LoopKind::kHole, number,
             layer.contours, facts_);
  }

  // "x,y x,y …", or as SVG also allows, any commas and blanks.
  void read_points(const pugi::xml_node& node) {
    points_.clear();
    std::string_view text = node.attribute("points").value();
    Vec2 point;
    std::size_t count = 0;
    constexpr std::string_view kBetween = " ,\t\r\n";
    for (skip(text, kBetween); !text.empty(); skip(text, kBetween)) {
      double& value = count % 2 == 0 ? point.x : point.y;
      if (!take_number(text, value)) {
        fail(node,
             fmt::format("number {} of the points is malformed", count + 1));
      }
      if (++count % 2 != 0) continue;
      points_.push_back(mm_per_unit_ *
                        Vec2(point.x, is_slic3r_ ? point.y : -point.y));
    }
    if (count % 2 != 0) fail(node, "the last point has no y");
  }

  const std::string& path_;
  const std::string file_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  bool is_slic3r_ = false;
  double mm_per_unit_ = 1;
  std::vector<pugi::xml_node> groups_;
  std::vector<double> heights_;
  std::vector<Vec2> points_;
  LayerFileFacts facts_;
};

}  // namespace

LayerFileFacts read_svg(const std::string& path, const TakeLayer& take,
                        const FileAccess& access) {
  return SvgReader(path, access).read(take);
}

}  // namespace lamina::slicer
