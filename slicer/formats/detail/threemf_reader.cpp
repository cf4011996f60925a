// Reads the slices of 3MF files (docs/formats.md): one stack, whatever the mesh
// is that stands in for it.

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/file/format_error.h"
#include "base/file/length_units.h"
#include "base/file/xml.h"
#include "base/file/zip.h"
#include "base/text.h"
#include "plane/loop_area.h"
#include "slicer/formats/detail/reading.h"

namespace lamina::slicer {
namespace {

// The model of an archive; nothing where it is not an archive with one.
std::optional<std::string> read_model(std::string_view bytes) {
  return ZipArchive::open(bytes).read(kThreemfModel);
}

class ThreemfReader {
 public:
  ThreemfReader(const std::string& path, const FileAccess& access)
      : path_(path), file_(read_whole(path, access)) {
    std::optional<std::string> model;
    try {
      model = read_model(file_);
    } catch (const FormatError& error) {
      fail_to_read(path, error.what());
    }
    if (!model)
      fail_to_read(path, fmt::format("it holds no {}", kThreemfModel));
    if (const auto fault = load_xml(*model, document_)) {
      fail_to_read(path, fmt::format("{} at byte {}: {}", kThreemfModel,
                                     fault->place, fault->words));
    }
    unit_ = length_of_unit(root().attribute("unit").value());
    if (unit_ == 0) {
      fail_to_read(path, fmt::format("unknown unit '{}'",
                                     root().attribute("unit").value()));
    }
  }

  LayerFileFacts read(const TakeLayer& take) {
    std::size_t stacks = 0;
    for_each_child(root(), "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "slicestack", [&](const pugi::xml_node& stack) {
        if (++stacks > 1) {
          fail_to_read(path_, "it holds several stacks of slices");
        }
        read_stack(stack, take);
      });
    });
    if (stacks == 0) fail_to_read(path_, "it holds no slices");
    LayerFileFacts facts = facts_;
    facts.format = "3MF with slices";
    for_each_child(root(), "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "object", [&](const pugi::xml_node& object) {
        facts.deviation = deviation_of(object.attribute("name").value());
      });
    });
    for_each_child(root(), "metadata", [&](const pugi::xml_node& metadata) {
      if (metadata.attribute("name").value() == std::string_view("Application"))
        facts.writer = metadata.child_value();
    });
    return facts;
  }

 private:
  pugi::xml_node root() const { return document_.document_element(); }

  // "contours within 0.001 mm", as lamina names its object.
  static std::optional<double> deviation_of(std::string_view name) {
    constexpr std::string_view kBegin = "contours within ";
    constexpr std::string_view kEnd = " mm";
    if (!name.starts_with(kBegin) || !name.ends_with(kEnd)) return {};
    name.remove_prefix(kBegin.size());
    name.remove_suffix(kEnd.size());
    return parse_number(name);
  }

  double number(const pugi::xml_node& node, const char* attribute) const {
    const std::string_view text = node.attribute(attribute).value();
    const auto value = parse_number(text);
    if (!value) {
      fail_to_read(path_, fmt::format("expected a number in {} of a {}, not "
                                      "'{}'",
                                      attribute, local_name(node), text));
    }
    return *value * unit_;
  }

  std::size_t index(const pugi::xml_node& node, const char* attribute) const {
    const std::string_view text = node.attribute(attribute).value();
    std::size_t value = 0;
    const auto [end, fault] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() ||
        value >= vertices_.size()) {
      fail_to_read(path_, fmt::format("there is no vertex '{}'", text));
    }
    return value;
  }

  void read_stack(const pugi::xml_node& stack, const TakeLayer& take) {
    for_each_child(stack, "sliceref", [&](const pugi::xml_node& /*other*/) {
      fail_to_read(path_,
                   "slices in other parts of the package (sliceref) are not "
                   "supported");
    });
    double bottom = stack.attribute("zbottom") ? number(stack, "zbottom") : 0;
    for_each_child(stack, "slice", [&](const pugi::xml_node& slice) {
      Layer layer;
      layer.bottom = bottom;
      layer.top = bottom = number(slice, "ztop");
      layer.section_z = (layer.bottom + layer.top) / 2;
      ++count_;
      read_slice(slice, layer.contours);
      take(layer);
    });
  }

  void read_slice(const pugi::xml_node& slice, plane::Contours& contours) {
    vertices_.clear();
    for_each_child(slice, "vertices", [&](const pugi::xml_node& vertices) {
      for_each_child(vertices, "vertex", [&](const pugi::xml_node& vertex) {
        vertices_.emplace_back(number(vertex, "x"), number(vertex, "y"));
      });
    });
    for_each_child(slice, "polygon", [&](const pugi::xml_node& polygon) {
      loop_.assign(
          1, vertices_.empty() ? Vec2(0) : vertices_[index(polygon, "startv")]);
      for_each_child(polygon, "segment", [&](const pugi::xml_node& segment) {
        loop_.push_back(vertices_[index(segment, "v2")]);
      });
      if (loop_.size() > 1 && loop_.front() == loop_.back()) {
        loop_.pop_back();
      } else {
        facts_.open_loops.add(count_, loop_);
      }
      // The positive fill rule: what runs clockwise takes away.
      add_loop(loop_,
               signed_area(loop_) < 0 ? LoopKind::kHole : LoopKind::kOuter,
               count_, contours, facts_);
    });
  }

  const std::string path_;
  const std::string file_;
  pugi::xml_document document_;
  double unit_ = 1;
  std::vector<Vec2> vertices_;  // of the slice that is being read
  std::vector<Vec2> loop_;
  std::size_t count_ = 0;  // of slices, with the one being read
  LayerFileFacts facts_;   // what was noted while reading
};

}  // namespace

LayerFileFacts read_3mf(const std::string& path, const TakeLayer& take,
                        const FileAccess& access) {
  return ThreemfReader(path, access).read(take);
}

bool has_slices(const std::string& path, const FileAccess& access) {
  const std::optional<std::string> bytes = access.read(path);
  if (!bytes || !ZipArchive::is_zip(*bytes)) return false;
  try {
    const std::optional<std::string> model = read_model(*bytes);
    return model && model->find("slicestack") != std::string::npos;
  } catch (const FormatError&) {
    return false;
  }
}

}  // namespace lamina::slicer
