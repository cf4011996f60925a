#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>

#include "base/file/zip.h"
#include "csg/import/detail/text_lines.h"
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

// What the slice extension says of an object whose slices count.
bool has_low_resolution(const pugi::xml_node& object) {
  for (const pugi::xml_attribute& attribute : object.attributes()) {
    const std::string_view name = attribute.name();
    if (name.substr(name.rfind(':') + 1) == "meshresolution") {
      return attribute.value() == std::string_view("lowres");
    }
  }
  return false;
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

// What a build item names, with the objects that it is composed of.
class Assembler {
 public:
  explicit Assembler(const pugi::xml_node& model) {
    for_each_child(model, "resources", [&](const pugi::xml_node& resources) {
      for_each_child(resources, "object", [&](const pugi::xml_node& object) {
        objects_[object.attribute("id").value()] = object;
      });
    });
    for_each_child(model, "build", [&](const pugi::xml_node& build) {
      for_each_child(build, "item", [&](const pugi::xml_node& item) {
        add(item, glm::dmat4(read_transform(item)), 0);
      });
    });
  }

  std::vector<RawMesh> take() { return std::move(bodies_); }

 private:
  // OpenSCAD applies what stands outside first.
  void add(const pugi::xml_node& reference, const glm::dmat4& transform,
           int depth) {
    // Objects may name each other in a circle, or double with each step.
    constexpr int kDeepest = 100;
    constexpr std::size_t kMostBodies = 100'000;
    if (depth > kDeepest || bodies_.size() >= kMostBodies) {
      throw FormatError("3MF, too many components of components");
    }
    const char* const id = reference.attribute("objectid").value();
    const auto object = objects_.find(id);
    if (object == objects_.end()) {
      throw FormatError(fmt::format("3MF, there is no object '{}'", id));
    }
    for_each_child(object->second, "mesh", [&](const pugi::xml_node& mesh) {
      RawMesh& raw = bodies_.emplace_back(read_body(mesh));
      raw.is_stand_in = has_low_resolution(object->second);
      for (Vec3& vertex : raw.mesh.vertices) {
        vertex = Vec3(transform * glm::dvec4(vertex, 1));
      }
    });
    for_each_child(
        object->second, "components", [&](const pugi::xml_node& components) {
          for_each_child(
              components, "component", [&](const pugi::xml_node& component) {
                add(component,
                    glm::dmat4(read_transform(component)) * transform,
                    depth + 1);
              });
        });
  }

  std::map<std::string_view, pugi::xml_node> objects_;
  std::vector<RawMesh> bodies_;
};

}  // namespace

std::vector<RawMesh> parse_3mf(std::string_view bytes, Language rules) {
  const ZipArchive archive = ZipArchive::open(bytes);
  const std::string part = model_part(archive);
  const auto model = archive.read(part);
  if (!model) throw FormatError(fmt::format("3MF holds no '{}'", part));
  pugi::xml_document document;
  parse_xml(*model, "3MF", document);
  if (rules != Language::k2021) {
    return Assembler(document.document_element()).take();
  }
  std::vector<RawMesh> bodies;
  const auto read_object = [&](const pugi::xml_node& object) {
    for_each_child(object, "mesh", [&](const pugi::xml_node& mesh) {
      bodies.push_back(read_body(mesh));
      bodies.back().is_stand_in = has_low_resolution(object);
    });
  };
  for_each_child(document.document_element(), "resources",
                 [&](const pugi::xml_node& resources) {
                   for_each_child(resources, "object", read_object);
                 });
  return bodies;
}

}  // namespace lamina::csg
