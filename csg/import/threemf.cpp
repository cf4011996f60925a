#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>

#include "base/file/zip.h"
#include "base/text.h"
#include "csg/import/detail/modifier_parts.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/detail/units.h"
#include "csg/import/detail/xml.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {
namespace {

// The name of the model's part: where the package's relationships say, else
// where every program puts it.
std::string model_part(const ZipArchive& archive) {
  std::string part = "3D/3dmodel.model";
  const auto relationships = archive.read("_rels/.rels");
  if (!relationships) return part;
  pugi::xml_document document;
  parse_xml(*relationships, "3MF _rels/.rels", document);
  for_each_child(document.document_element(), "Relationship",
                 [&](const pugi::xml_node& relationship) {
                   const std::string_view type =
                       relationship.attribute("Type").value();
                   if (!type.ends_with("/3dmodel")) return;
                   part = relationship.attribute("Target").value();
                   if (part.starts_with('/')) part.erase(0, 1);
                 });
  return part;
}

template <typename Number>
Number read_number(const pugi::xml_node& node, const char* attribute) {
  const std::string_view text = node.attribute(attribute).value();
  const auto number = to_number<Number>(trim(text));
  if (!number) {
    throw FormatError(
        fmt::format("3MF, expected a number in {} of a {}, not '{}'", attribute,
                    local_name(node), text));
  }
  return *number;
}

RawMesh read_body(const pugi::xml_node& mesh) {
  RawMesh raw;
  const auto corner = [&raw](const pugi::xml_node& triangle, const char* name) {
    const auto index = read_number<std::uint32_t>(triangle, name);
    if (index >= raw.mesh.vertices.size()) {
      throw FormatError(fmt::format("3MF, there is no vertex {}", index));
    }
    return index;
  };
  read_mesh(mesh, "triangles", read_number<double>, corner, raw.mesh);
  return raw;
}

using BodyTransform = glm::dmat4x3;

// The attribute `transform`: twelve numbers, column by column; the identity
// where there is none.
BodyTransform read_transform(const pugi::xml_node& node) {
  std::string_view text = node.attribute("transform").value();
  if (trim(text).empty()) return BodyTransform(1.0);
  BodyTransform transform;
  for (int i = 0; i < 12; ++i) {
    const auto number = to_number<double>(take_word(text));
    if (!number) throw FormatError("3MF, a transform needs twelve numbers");
    transform[i / 3][i % 3] = *number;
  }
  return transform;
}

// The attribute of that name, whatever prefix its namespace has.
std::string_view attribute_of(const pugi::xml_node& node,
                              std::string_view name) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    if (local_name(std::string_view(attribute.name())) == name) {
      return attribute.value();
    }
  }
  return {};
}

// What the slice extension says of an object whose slices count.
bool has_low_resolution(const pugi::xml_node& object) {
  return attribute_of(object, "meshresolution") == "lowres";
}

// The parts of a package that hold objects, and what its build names.
class Assembler {
 public:
  Assembler(const ZipArchive& archive, Placing placing,
            std::optional<std::string_view> asked)
      : archive_(archive),
        placing_(placing),
        asked_(asked),
        root_(model_part(archive)),
        order_{root_},
        known_{root_} {
    read_parts();
    if (placing == Placing::kFile) modifiers_ = read_modifier_parts(archive);
  }

  PlacedMeshes run() {
    const pugi::xml_node model = parts_.at(root_).document_element();
    if (placing_ == Placing::kNone) {
      add_all();
    } else {
      for_each_item(model, [&](const pugi::xml_node& item) {
        add(root_, item, glm::dmat4(read_transform(item)), !asked_);
      });
    }
    if (placing_ == Placing::kNone && is_placed(model)) {
      meshes_.passed_over.push_back(fmt::format(
          "places {}, and each object counts once, where it lies, as in "
          "OpenSCAD 2021.01; with --language 2026 they are placed",
          counted(count_items(model), "item", "items")));
    }
    if (modifiers_.count > 0) {
      meshes_.passed_over.push_back(fmt::format(
          "has {} for a slicer, such as modifiers and support blockers, which "
          "are left out",
          counted(modifiers_.count, "volume", "volumes")));
    }
    heed_unit(model.attribute("unit").value(), placing_, meshes_);
    if (asked_ && !is_found_) {
      throw FormatError(fmt::format("3MF, there is no part '{}'", *asked_));
    }
    return std::move(meshes_);
  }

  std::vector<ThreemfPart> parts() {
    std::map<Name, std::size_t> counts;
    for_each_item(
        parts_.at(root_).document_element(), [&](const pugi::xml_node& item) {
          walk(root_, item, glm::dmat4(1.0), 0, true,
               [&](const Objects::value_type& object, const glm::dmat4&, bool) {
                 ++counts[object.first];
                 return true;
               });
        });
    std::vector<ThreemfPart> all;
    for (const std::string& part : order_) {
      for_each_object(
          parts_.at(part).document_element(),
          [&](const pugi::xml_node& object) {
            ThreemfPart& made = all.emplace_back();
            made.id = object.attribute("id").value();
            made.name = name_of(object);
            made.count = counts[{part, made.id}];
            for_each_child(object, "mesh", [&](const pugi::xml_node& mesh) {
              made.triangles += read_body(mesh).mesh.triangles.size();
            });
          });
    }
    return all;
  }

 private:
  using Name = std::pair<std::string, std::string>;  // of part and object
  using Objects = std::map<Name, pugi::xml_node>;

  template <typename Visit>
  static void for_each_object(const pugi::xml_node& model, Visit visit) {
    for_each_child(model, "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "object", visit);
    });
  }
  template <typename Visit>
  static void for_each_item(const pugi::xml_node& model, Visit visit) {
    for_each_child(model, "build", [&](const pugi::xml_node& build) {
      for_each_child(build, "item", visit);
    });
  }

  // Reads the first part, those that its items and components name, and so on.
  void read_parts() {
    for (std::size_t i = 0; i < order_.size(); ++i) read_part(order_[i]);
  }
  void read_part(const std::string part) {
    const auto bytes = archive_.read(part);
    if (!bytes) throw FormatError(fmt::format("3MF holds no '{}'", part));
    bytes_read_ += bytes->size();
    if (bytes_read_ > archive_.most_bytes()) {
      throw FormatError("3MF, the parts are too large");
    }
    pugi::xml_document& document = parts_[part];
    parse_xml(*bytes, "3MF", document);
    const auto take_name = [&](const pugi::xml_node& reference) {
      std::string name = part_of(reference, part);
      if (known_.insert(name).second) order_.push_back(std::move(name));
    };
    const pugi::xml_node model = document.document_element();
    for_each_object(model, [&](const pugi::xml_node& object) {
      objects_[{part, object.attribute("id").value()}] = object;
      for_each_component(object, take_name);
    });
    for_each_item(model, take_name);
  }

  template <typename Visit>
  static void for_each_component(const pugi::xml_node& object, Visit visit) {
    for_each_child(object, "components", [&](const pugi::xml_node& components) {
      for_each_child(components, "component", visit);
    });
  }

  // The part that holds what an item or component of `part` names.
  static std::string part_of(const pugi::xml_node& reference,
                             const std::string& part) {
    std::string_view path = attribute_of(reference, "path");
    if (path.empty()) return part;
    if (path.starts_with('/')) path.remove_prefix(1);
    return std::string(path);
  }

  // Whether the build says more than that each object is there.
  bool is_placed(const pugi::xml_node& model) const {
    std::size_t items = 0;
    bool is_moved = false;
    for_each_item(model, [&](const pugi::xml_node& item) {
      ++items;
      is_moved |= read_transform(item) != BodyTransform(1.0);
    });
    std::size_t meshes = 0;
    bool has_components = false;
    for (const auto& [name, object] : objects_) {
      for_each_child(object, "mesh", [&](const pugi::xml_node&) { ++meshes; });
      for_each_component(object, [&](const pugi::xml_node& component) {
        has_components = true;
        is_moved |= read_transform(component) != BodyTransform(1.0);
      });
    }
    return is_moved || (!has_components && items != meshes);
  }
  static std::size_t count_items(const pugi::xml_node& model) {
    std::size_t count = 0;
    for_each_item(model, [&](const pugi::xml_node&) { ++count; });
    return count;
  }

  std::string_view name_of(const pugi::xml_node& object) const {
    const auto named = modifiers_.names.find(object.attribute("id").value());
    return named == modifiers_.names.end() ? object.attribute("name").value()
                                           : std::string_view(named->second);
  }
  bool is_asked(const pugi::xml_node& object) {
    if (!asked_) return true;
    const bool is_it =
        name_of(object) == *asked_ || object.attribute("id").value() == *asked_;
    is_found_ |= is_it;
    return is_it;
  }

  // Each object once, where it lies.
  void add_all() {
    for (const std::string& part : order_) {
      for_each_object(parts_.at(part).document_element(),
                      [&](const pugi::xml_node& object) {
                        if (is_asked(object)) {
                          add_mesh(object, glm::dmat4(1.0));
                        }
                      });
    }
  }

  void add_mesh(const pugi::xml_node& object, const glm::dmat4& transform) {
    for_each_child(object, "mesh", [&](const pugi::xml_node& mesh) {
      RawMesh& raw = meshes_.bodies.emplace_back(read_body(mesh));
      drop_modifiers(object, raw.mesh);
      raw.is_stand_in = has_low_resolution(object);
      if (transform == glm::dmat4(1.0)) return;
      for (Vec3& vertex : raw.mesh.vertices) {
        vertex = Vec3(transform * glm::dvec4(vertex, 1));
      }
    });
  }

  void drop_modifiers(const pugi::xml_node& object, Mesh& mesh) const {
    const auto found =
        modifiers_.triangles.find(object.attribute("id").value());
    if (found == modifiers_.triangles.end()) return;
    std::erase_if(mesh.triangles, [&, i = 0U](const auto&) mutable {
      const std::uint32_t number = i++;
      return std::ranges::any_of(found->second, [&](const auto& range) {
        return range.first <= number && number <= range.second;
      });
    });
  }

  // Adds what an item or component of `part` names, and its components.
  //
  // is_wanted  whether it is one of a part that was asked for
  void add(const std::string& part, const pugi::xml_node& reference,
           const glm::dmat4& transform, bool is_wanted) {
    walk(part, reference, transform, 0, is_wanted,
         [&](const Objects::value_type& object, const glm::dmat4& placed,
             bool is_inside_wanted) {
           const bool is_wanted_too =
               is_asked(object.second) || is_inside_wanted;
           if (is_wanted_too) add_mesh(object.second, placed);
           return is_wanted_too;
         });
  }

  // Calls take(object, transform, value) for what an item or component of
  // `part` names, and for its components with the value that this gives.
  template <typename Take>
  void walk(const std::string& part, const pugi::xml_node& reference,
            const glm::dmat4& transform, int depth, bool value,
            const Take& take) {
    // Objects may name each other in a circle, or double with each step.
    constexpr int kDeepest = 100;
    constexpr std::size_t kMostSteps = 100'000;
    if (depth > kDeepest || ++steps_ > kMostSteps) {
      throw FormatError("3MF, too many components of components");
    }
    const std::string home = part_of(reference, part);
    const char* const id = reference.attribute("objectid").value();
    const auto object = objects_.find({home, id});
    if (object == objects_.end()) {
      throw FormatError(fmt::format("3MF, there is no object '{}'", id));
    }
    const bool inner = take(*object, transform, value);
    for_each_component(object->second, [&](const pugi::xml_node& component) {
      if (modifiers_.components.contains(
              {id, component.attribute("objectid").value()})) {
        return;
      }
      const glm::dmat4 own(read_transform(component));
      // OpenSCAD applies what stands outside first.
      walk(home, component,
           placing_ == Placing::kFile ? transform * own : own * transform,
           depth + 1, inner, take);
    });
  }

  const ZipArchive& archive_;
  const Placing placing_;
  const std::optional<std::string_view> asked_;
  bool is_found_ = false;
  std::size_t steps_ = 0;
  const std::string root_;
  std::size_t bytes_read_ = 0;
  std::map<std::string, pugi::xml_document> parts_;
  std::vector<std::string> order_;  // in which they are read
  std::set<std::string> known_;     // the same names
  ModifierParts modifiers_;
  Objects objects_;
  PlacedMeshes meshes_;
};

}  // namespace

PlacedMeshes parse_3mf(std::string_view bytes, Placing placing,
                       std::optional<std::string_view> part) {
  const ZipArchive archive = ZipArchive::open(bytes);
  return Assembler(archive, placing, part).run();
}

std::vector<ThreemfPart> threemf_parts(std::string_view bytes) {
  const ZipArchive archive = ZipArchive::open(bytes);
  return Assembler(archive, Placing::kFile, std::nullopt).parts();
}

}  // namespace lamina::csg
