#pragma once
// Elements of XML documents.

#include <string_view>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/file/format_error.h"
#include "base/file/xml.h"
#include "csg/scene.h"

namespace lamina::csg {

// Throws FormatError, whose message begins with `format`, where the bytes are
// malformed; std::bad_alloc.
inline void parse_xml(std::string_view bytes, std::string_view format,
                      pugi::xml_document& document) {
  if (const auto fault = load_xml(bytes, document)) {
    throw FormatError(
        fmt::format("{} byte {}, {}", format, fault->place, fault->words));
  }
}

// Appends the vertices and the triangles of a <mesh>, as AMF and 3MF have them.
//
// parents     name of the elements that hold triangles
// coordinate  gives a vertex' coordinate by its name, "x", "y" or "z"
// corner      gives a triangle's corner by its name, "v1", "v2" or "v3"
template <typename Coordinate, typename Corner>
void read_mesh(const pugi::xml_node& mesh, std::string_view parents,
               Coordinate coordinate, Corner corner, Mesh& result) {
  for_each_child(mesh, "vertices", [&](const pugi::xml_node& vertices) {
    for_each_child(vertices, "vertex", [&](const pugi::xml_node& v) {
      result.vertices.push_back(
          {coordinate(v, "x"), coordinate(v, "y"), coordinate(v, "z")});
    });
  });
  for_each_child(mesh, parents, [&](const pugi::xml_node& parent) {
    for_each_child(parent, "triangle", [&](const pugi::xml_node& t) {
      result.triangles.push_back(
          {corner(t, "v1"), corner(t, "v2"), corner(t, "v3")});
    });
  });
}

}  // namespace lamina::csg
