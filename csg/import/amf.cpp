#include <fmt/format.h>

#include "base/file/zip.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/detail/xml.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {
namespace {

// The text of the child element.
std::string_view child_text(const pugi::xml_node& node, const char* child) {
  return trim(node.child(child).text().get());
}

[[noreturn]] void fail(std::string_view expected, std::string_view text) {
  throw FormatError(fmt::format("AMF, expected {}, not '{}'", expected, text));
}

double read_coordinate(const pugi::xml_node& vertex, const char* name) {
  const std::string_view text = child_text(vertex.child("coordinates"), name);
  const auto number = to_number<double>(text);
  if (!number) fail("a coordinate", text);
  return *number;
}

std::vector<RawMesh> parse_model(std::string_view bytes) {
  pugi::xml_document document;
  parse_xml(bytes, "AMF", document);
  std::vector<RawMesh> bodies;
  for_each_child(
      document.child("amf"), "object", [&](const pugi::xml_node& object) {
        RawMesh& raw = bodies.emplace_back();
        const auto corner = [&raw](const pugi::xml_node& triangle,
                                   const char* name) {
          const std::string_view text = child_text(triangle, name);
          const auto index = to_number<std::uint32_t>(text);
          if (!index || *index >= raw.mesh.vertices.size()) {
            fail("the index of a vertex", text);
          }
          return *index;
        };
        for_each_child(object, "mesh", [&](const pugi::xml_node& mesh) {
          read_mesh(mesh, "volume", read_coordinate, corner, raw.mesh);
        });
      });
  return bodies;
}

}  // namespace

std::vector<RawMesh> parse_amf(std::string_view bytes,
                               const std::string& name) {
  if (!ZipArchive::is_zip(bytes)) return parse_model(bytes);
  const ZipArchive archive = ZipArchive::open(bytes);
  auto model = archive.read(name);
  if (!model && archive.names().size() == 1) {
    model = archive.read(archive.names().front());
  }
  if (!model) {
    throw FormatError(fmt::format("AMF archive holds no '{}'", name));
  }
  return parse_model(*model);
}

}  // namespace lamina::csg
