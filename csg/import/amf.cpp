#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/file/zip.h"
#include "base/text.h"
#include "csg/degrees.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/detail/units.h"
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

double read_number(std::string_view text, std::string_view expected) {
  const auto number = to_number<double>(text);
  if (!number) fail(expected, text);
  return *number;
}

double read_coordinate(const pugi::xml_node& vertex, const char* name) {
  return read_number(child_text(vertex.child("coordinates"), name),
                     "a coordinate");
}

RawMesh read_object(const pugi::xml_node& object) {
  RawMesh raw;
  const auto corner = [&raw](const pugi::xml_node& triangle, const char* name) {
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
  return raw;
}

// A number of an instance; 0 where it does not say.
double read_placing(const pugi::xml_node& instance, const char* name) {
  const std::string_view text = child_text(instance, name);
  return text.empty() ? 0 : read_number(text, "a number");
}

// Turned about x, y and z, one after the other, and moved.
Affine read_instance(const pugi::xml_node& instance) {
  Mat4 turn(1.0);
  const std::array<const char*, 3> kTurns = {"rx", "ry", "rz"};
  for (int axis = 0; axis < 3; ++axis) {
    const double angle_deg =
        read_placing(instance, kTurns[static_cast<std::size_t>(axis)]);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Mat4 about(1.0);
    about[u][u] = about[v][v] = cos_deg(angle_deg);
    about[u][v] = sin_deg(angle_deg);
    about[v][u] = -about[u][v];
    turn = about * turn;
  }
  turn[3] =
      Vec4(read_placing(instance, "deltax"), read_placing(instance, "deltay"),
           read_placing(instance, "deltaz"), 1);
  return Affine(turn);
}

PlacedMeshes parse_model(std::string_view bytes, Placing placing) {
  pugi::xml_document document;
  parse_xml(bytes, "AMF", document);
  const pugi::xml_node amf = document.child("amf");
  PlacedMeshes meshes;
  std::map<std::string_view, std::size_t> numbers;  // in bodies, by id
  for_each_child(amf, "object", [&](const pugi::xml_node& object) {
    numbers[object.attribute("id").value()] = meshes.bodies.size();
    meshes.bodies.push_back(read_object(object));
  });
  std::vector<RawMesh> placed;
  std::size_t instances = 0;
  bool is_moved = false;
  for_each_child(amf, "constellation", [&](const pugi::xml_node& all) {
    for_each_child(all, "instance", [&](const pugi::xml_node& instance) {
      ++instances;
      const Affine transform = read_instance(instance);
      is_moved |= transform != Affine(1.0);
      const auto found = numbers.find(instance.attribute("objectid").value());
      if (found == numbers.end() || placing != Placing::kFile) return;
      placed.push_back(meshes.bodies[found->second]);
      for (Vec3& vertex : placed.back().mesh.vertices) {
        vertex = transform * Vec4(vertex, 1);
      }
    });
  });
  if (!placed.empty()) {
    meshes.bodies = std::move(placed);
  } else if (placing != Placing::kFile &&
             (is_moved || (instances > 0 && instances != numbers.size()))) {
    meshes.passed_over.push_back(fmt::format(
        "places {}, and each object counts once, where it lies, as in OpenSCAD",
        counted(instances, "instance", "instances")));
  }
  heed_unit(amf.attribute("unit").value(), placing, meshes);
  return meshes;
}

}  // namespace

PlacedMeshes parse_amf(std::string_view bytes, const std::string& name,
                       Placing placing) {
  if (!ZipArchive::is_zip(bytes)) return parse_model(bytes, placing);
  const ZipArchive archive = ZipArchive::open(bytes);
  auto model = archive.read(name);
  if (!model && archive.names().size() == 1) {
    model = archive.read(archive.names().front());
  }
  if (!model) {
    throw FormatError(fmt::format("AMF archive holds no '{}'", name));
  }
  return parse_model(*model, placing);
}

}  // namespace lamina::csg
