#include <string>

#include <fmt/format.h>

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

}  // namespace

std::vector<RawMesh> parse_3mf(std::string_view bytes) {
  const ZipArchive archive = ZipArchive::open(bytes);
  const std::string part = model_part(archive);
  const auto model = archive.read(part);
  if (!model) throw FormatError(fmt::format("3MF holds no '{}'", part));
  pugi::xml_document document;
  parse_xml(*model, "3MF", document);
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
