#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "csg/import/mesh_file.h"
#include "csg/solid/detail/face.h"
#include "csg/solid/detail/lowerer.h"
#include "csg/solid/detail/mend.h"

namespace lamina::csg {
namespace {

// Closed and consistent, whatever the file has.
Mesh make_sound(RawMesh raw, SourceRange range, Diagnostics& diagnostics) {
  Mesh mesh = std::move(raw.mesh);
  for (const std::vector<std::uint32_t>& polygon : raw.polygons) {
    for (const auto& t : triangulate_face(mesh.vertices, polygon)) {
      mesh.triangles.push_back(t);
    }
  }
  mend_and_report(mesh, range, diagnostics);
  return mesh;
}

Leaf make_import_leaf(const ImportParams& params, SourceRange range,
                      Diagnostics& diagnostics) {
  Leaf leaf;
  leaf.may_overlap_itself = true;
  for (RawMesh& raw : read_mesh_file(std::string(params.path), params.format,
                                     range, diagnostics)) {
    leaf.meshes.push_back(make_sound(std::move(raw), range, diagnostics));
  }
  return leaf;
}

void report_unknown_format(const ImportParams& params, SourceRange range,
                           Diagnostics& diagnostics) {
  const std::filesystem::path path(params.path);
  diagnostics.error(
      range,
      fmt::format(
          "Unsupported file format while trying to import file "
          "'\"{}\"', import() at line {}",
          path.lexically_proximate(std::filesystem::current_path())
              .generic_string(),
          range.is_known() ? range.source->openscad_line(range.begin) : 0));
}

}  // namespace

Shape Lowerer::lower_op(const Import& op, const Node& node,
                        const Affine& world) {
  const ImportParams& params = *op.params;
  const std::string key = fmt::format("{} {}", params.path, params.csg_text);
  const auto [entry, is_new] = file_shapes_.try_emplace(key);
  if (is_new) entry->second = read_import(params, node);
  return place_file(entry->second, node, world);
}

Lowerer::FileShape Lowerer::read_import(const ImportParams& params,
                                        const Node& node) {
  FileShape shape{Dimension::kSolid};
  switch (params.format) {
    case ImportFormat::kUnknown:
      report_unknown_format(params, node.range, diagnostics_);
      break;
    case ImportFormat::kDxf:
    case ImportFormat::kSvg:
      fail_unsupported(node, "import");
    case ImportFormat::kStl:
    case ImportFormat::kOff:
    case ImportFormat::kObj:
    case ImportFormat::kAmf:
    case ImportFormat::k3mf:
      shape.leaf = add_leaf(make_import_leaf(params, node.range, diagnostics_));
      break;
  }
  return shape;
}

Shape Lowerer::place_file(const FileShape& shape, const Node& node,
                          const Affine& world) {
  if (shape.leaf) place(*shape.leaf, Vec3(1), node, world);
  return {shape.dimension, shape.region};
}

Shape Lowerer::lower_op(const Surface&, const Node& node, const Affine&) {
  fail_unsupported(node, "surface");
}

}  // namespace lamina::csg
