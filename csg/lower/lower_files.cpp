#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "base/file/file_access.h"
#include "base/file/format_error.h"
#include "base/paths.h"
#include "csg/boundary/near_hull.h"
#include "csg/import/decimate.h"
#include "csg/import/dxf.h"
#include "csg/import/mesh_file.h"
#include "csg/import/surface_file.h"
#include "csg/import/svg.h"
#include "csg/limits.h"
#include "csg/lower/detail/cad_file.h"
#include "csg/lower/detail/face.h"
#include "csg/lower/detail/lowerer.h"
#include "csg/lower/detail/repair.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"

namespace lamina::csg {
namespace {

// --- Meshes -----------------------------------------------------------------

// Closed and consistent, whatever the file has.
Mesh make_sound(RawMesh raw, SourceRange range, Diagnostics& diagnostics) {
  Mesh mesh = std::move(raw.mesh);
  for (const std::vector<std::uint32_t>& polygon : raw.polygons) {
    add_face(mesh, polygon);
  }
  repair_and_report(mesh, range, diagnostics,
                    raw.is_joined ? Vertices::kJoined : Vertices::kAnyhow);
  return mesh;
}

// Puts the middle of the box of all faces at the origin.
void center_meshes(std::vector<Mesh>& meshes) {
  Vec3 low(plane::kGreatestCoordinate);
  Vec3 high(-plane::kGreatestCoordinate);
  for (const Mesh& mesh : meshes) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        low = glm::min(low, mesh.vertices[corner]);
        high = glm::max(high, mesh.vertices[corner]);
      }
    }
  }
  const Vec3 middle = (low + high) / 2.0;
  for (Mesh& mesh : meshes) {
    for (Vec3& vertex : mesh.vertices) vertex -= middle;
  }
}

void report(const Decimation& done, double tolerance, std::string_view path,
            Diagnostics& diagnostics) {
  std::string told =
      fmt::format("{}: {} of {} triangles, within {:.6g} of the file's surface",
                  quoted_path(path), done.triangles_after,
                  done.triangles_before, tolerance);
  if (done.tangled_edges + done.tangled_vertices > 0) {
    told += fmt::format(
        " (kept whole where it is no manifold: {} edges, {} "
        "vertices)",
        done.tangled_edges, done.tangled_vertices);
  }
  diagnostics.own_remark({}, std::move(told));
}

// depth      to which a mesh may lie below its hull, which then stands for it
// tolerance  of decimation, in the file's lengths; 0: none
Leaf make_import_leaf(std::vector<RawMesh> bodies, const ImportParams& params,
                      double depth, double tolerance,
                      const LowerOptions& options, SourceRange range,
                      Diagnostics& diagnostics) {
  Leaf leaf;
  leaf.may_overlap_itself = true;
  for (RawMesh& raw : bodies) {
    Mesh mesh = make_sound(std::move(raw), range, diagnostics);
    if (depth > 0) {
      if (auto hull = near_hull(mesh, depth)) mesh = std::move(*hull);
    }
    if (tolerance > 0 && !mesh.triangles.empty()) {
      report(decimate(mesh, tolerance, options.module_folders, diagnostics),
             tolerance, params.path, diagnostics);
    }
    leaf.meshes.push_back(std::move(mesh));
  }
  if (params.center) center_meshes(leaf.meshes);
  return leaf;
}

// --- Drawings ---------------------------------------------------------------

// Fills each shape where its contours enclose a point an odd number of times,
// and unites all shapes.
plane::Region fill_shapes(std::span<const std::vector<plane::Contour>> shapes) {
  std::vector<plane::Region> regions;
  for (const std::vector<plane::Contour>& contours : shapes) {
    regions.push_back(plane::from_contours(contours));
  }
  return regions.empty() ? plane::Region() : plane::unite(regions);
}

// Puts the middle of the box of all contours at the origin.
void center_contours(std::vector<plane::Contour>& contours) {
  Vec2 low(plane::kGreatestCoordinate);
  Vec2 high(-plane::kGreatestCoordinate);
  for (const plane::Contour& contour : contours) {
    for (const Vec2 point : contour) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  const Vec2 middle = (low + high) / 2.0;
  for (plane::Contour& contour : contours) {
    for (Vec2& point : contour) point -= middle;
  }
}

plane::Region read_dxf(const ImportParams& params, const Fineness& fineness,
                       const FileAccess& access, SourceRange range,
                       Diagnostics& diagnostics) {
  DxfOptions options{std::string(params.layer.value_or("")),
                     params.origin,
                     params.scale,
                     {},
                     std::string(params.path)};
  options.fragments = [&fineness](double r) {
    return circle_fragments(r, fineness);
  };
  const auto bytes = access.read_regular(options.path);
  if (!bytes) {
    diagnostics.warning(range,
                        fmt::format("Can't open DXF file '{}'.", options.path));
    return {};
  }
  DxfDrawing drawing;
  try {
    drawing = parse_dxf(*bytes, options);
  } catch (const FormatError& fault) {
    diagnostics.error(range, fmt::format("{} importing file '{}'", fault.what(),
                                         options.path));
    return {};
  }
  for (std::string& warning : drawing.warnings) {
    diagnostics.warning(range, std::move(warning));
  }
  for (std::string& warning : unknown_entity_warnings(
           drawing, options.layer, quoted_path(options.path))) {
    diagnostics.warning(range, std::move(warning));
  }
  if (drawing.straightened_arcs > 0) {
    diagnostics.warning(
        range,
        fmt::format("{} arcs (bulges) of polylines in {} become straight "
                    "lines",
                    drawing.straightened_arcs, quoted_path(options.path)));
  }
  std::vector<plane::Contour> contours;
  for (DxfPath& path : drawing.paths) {
    contours.push_back(std::move(path.points));  // open ones are closed, too
  }
  if (params.center) center_contours(contours);
  return fill_shapes({&contours, 1});
}

// How far OpenSCAD's pen leaves round caps and joins, in the drawing's units.
double arc_tolerance(double width, Language rules) {
  // 2021.01's; of strokes that are wider than a metre such a share of their
  // width that a circle has 10,000 sides.
  constexpr double kArcTolerance = 2.5e-5;
  constexpr double kArcShare = 2.5e-8;
  // Clipper2's of the radius: a circle has 50 sides.
  constexpr double kRadiusShare = 0.002;
  return rules == Language::k2021 ? std::max(kArcTolerance, kArcShare * width)
                                  : kRadiusShare * width / 2;
}

SvgContours outline_stroke(std::span<const Vec2> path, const SvgStroke& stroke,
                           Language rules) {
  const double tolerance = arc_tolerance(stroke.width, rules);
  const plane::Join join =
      stroke.join == SvgStroke::Join::kRound   ? plane::Join::kRound
      : stroke.join == SvgStroke::Join::kBevel ? plane::Join::kBevel
                                               : plane::Join::kMiter;
  const plane::Cap cap = stroke.cap == SvgStroke::Cap::kButt ? plane::Cap::kButt
                         : stroke.cap == SvgStroke::Cap::kRound
                             ? plane::Cap::kRound
                             : plane::Cap::kSquare;
  return plane::stroke(path, stroke.width, join, cap, tolerance).contours;
}

// In 2021.01 the fineness of curves is the same whatever $fn, $fa and $fs are.
SvgCurves svg_curves(const Fineness& fineness, Language rules) {
  if (rules == Language::k2021) return {};
  SvgCurves curves;
  curves.lines_of_arc = [&fineness](double radius, double sweep_deg) {
    return static_cast<int>(
        std::ceil(circle_fragments(radius, fineness) * sweep_deg / 360));
  };
  curves.lines_of_bezier = static_cast<int>(
      std::clamp<double>(fineness.facets.fn, 0, kMostFragments));
  return curves;
}

SvgOptions svg_options(const ImportParams& params, const Fineness& fineness) {
  SvgOptions options;
  options.dpi = params.dpi;
  options.center = params.center;
  options.outline = [rules = params.rules](std::span<const Vec2> path,
                                           const SvgStroke& stroke) {
    return outline_stroke(path, stroke, rules);
  };
  if (params.id) options.id = std::string(*params.id);
  if (params.layer) options.layer = std::string(*params.layer);
  options.language = params.rules;
  options.curves = svg_curves(fineness, params.rules);
  return options;
}

void report_undrawn(const SvgDrawing& drawing, const ImportParams& params,
                    SourceRange range, Diagnostics& diagnostics) {
  if (!drawing.has_match) {
    std::string filter;
    if (params.id) filter = fmt::format("id = \"{}\"", *params.id);
    if (params.id && params.layer) filter += ", ";
    if (params.layer) filter += fmt::format("layer = \"{}\"", *params.layer);
    diagnostics.warning(
        range,
        fmt::format("import() filter {} did not match anything", filter));
  }
  for (const std::string& element : drawing.undrawn) {
    diagnostics.warning(range, fmt::format("{} in {} draws nothing", element,
                                           quoted_path(params.path)));
  }
}

plane::Region read_svg(const ImportParams& params, const Fineness& fineness,
                       const FileAccess& access, SourceRange range,
                       Diagnostics& diagnostics) {
  const auto bytes = access.read_regular(std::string(params.path));
  if (!bytes) {
    diagnostics.error(range, fmt::format("Can't open file '{}'{}", params.path,
                                         at_import(range)));
    return {};
  }
  SvgDrawing drawing;
  try {
    drawing = parse_svg(*bytes, svg_options(params, fineness));
  } catch (const FormatError& fault) {
    diagnostics.report({Severity::kError,
                        range,
                        fmt::format("Error parsing file '{}'{}", params.path,
                                    at_import(range)),
                        {},
                        {{range, fault.what()}}});
    return {};
  }
  report_undrawn(drawing, params, range, diagnostics);
  return fill_shapes(drawing.shapes);
}

}  // namespace

Shape Lowerer::lower_op(const Import& op, const Place& at) {
  const ImportParams& params = *op.params;
  Fineness fine = fineness(params.facets, at.world);
  if (is_cad(params.format) && !(fine.chordal_error > 0)) {
    fine.chordal_error = chordal_error_of_parts_at(at.world);
  }
  const double decimation = decimation_of(params, at.world);
  const std::string key =
      fmt::format("{} {} {} {}", params.path, params.csg_text,
                  fine.chordal_error, decimation);
  const auto [entry, is_new] = file_shapes_.try_emplace(key);
  if (is_new) {
    const std::size_t messages = diagnostics_.all().size();
    entry->second = read_import(params, fine, decimation, at.node);
    const bool is_empty =
        !entry->second.leaf && entry->second.region.is_empty();
    if (is_empty && diagnostics_.all().size() == messages) {
      diagnostics_.warning(at.node.range,
                           fmt::format("File {} holds nothing to import",
                                       quoted_path(params.path)));
    }
  }
  return place_file(entry->second, at);
}

double Lowerer::decimation_of(const ImportParams& params,
                              const Affine& world) const {
  if (params.decimate) return *params.decimate;
  // Files of CAD programs have their own chordal error.
  return is_cad(params.format) ? 0 : decimation_at(world);
}

double Lowerer::chordal_error_of_parts_at(const Affine& world) const {
  const double stretch = greatest_stretch(world);
  const double error = options_.chordal_error_of_parts / stretch;
  return std::isfinite(error) ? error : kChordalErrorOfParts;
}

double Lowerer::decimation_at(const Affine& world) const {
  const double tolerance = options_.decimation / greatest_stretch(world);
  return std::isfinite(tolerance) ? tolerance : 0;  // else it has no volume
}

Lowerer::FileShape Lowerer::read_import(const ImportParams& params,
                                        const Fineness& fine, double decimation,
                                        const Node& node) {
  const FileAccess& access = *options_.file_access;
  const SourceRange range = node.range;
  switch (params.format) {
    case ImportFormat::kUnknown:
      diagnostics_.error(
          range, fmt::format("Unsupported file format while trying to import "
                             "file '{}'{}",
                             quoted_path(params.path), at_import(range)));
      return {Dimension::kSolid};
    case ImportFormat::kDxf:
      return {Dimension::kFlat,
              read_dxf(params, fine, access, range, diagnostics_)};
    case ImportFormat::kSvg:
      return {Dimension::kFlat,
              read_svg(params, fine, access, range, diagnostics_)};
    case ImportFormat::kStl:
    case ImportFormat::kOff:
    case ImportFormat::kObj:
    case ImportFormat::kPly:
    case ImportFormat::kAmf:
    case ImportFormat::k3mf:
    case ImportFormat::kStep:
    case ImportFormat::kIges:
    case ImportFormat::kBrep:
    case ImportFormat::kFcstd:
      break;
  }
  const double depth =
      is_cad(params.format) ? options_.hull_share * fine.chordal_error : 0;
  const auto make = [&] {
    return make_import_leaf(
        read_bodies(params, fine.chordal_error - depth, node), params, depth,
        decimation, options_, range, diagnostics_);
  };
  if (decimation == 0) return {Dimension::kSolid, {}, add_leaf(make())};
  const auto [kept, is_new] = shared_.decimated.try_emplace(
      fmt::format("{} {} {} {}", params.path, params.csg_text,
                  fine.chordal_error, decimation));
  if (is_new) kept->second = make();
  return {Dimension::kSolid, {}, add_leaf(kept->second)};
}

std::vector<RawMesh> Lowerer::read_bodies(const ImportParams& params,
                                          double chordal_error,
                                          const Node& node) {
  const FileAccess& access = *options_.file_access;
  if (!is_cad(params.format)) {
    return read_mesh_file(params, access, node.range, diagnostics_);
  }
  if (!options_.cad_reader) fail_unsupported(node, "import");
  return read_cad_file(params, chordal_error, *options_.cad_reader, access,
                       node.range, diagnostics_);
}

Shape Lowerer::lower_op(const Surface& op, const Place& at) {
  const SurfaceParams& params = *op.params;
  const std::string key = fmt::format("{} {}", params.path, params.csg_text);
  const auto [entry, is_new] = file_shapes_.try_emplace(key);
  if (is_new) {
    Leaf leaf;
    leaf.meshes.push_back(read_surface_file(params, *options_.file_access,
                                            at.node.range, diagnostics_));
    entry->second = {Dimension::kSolid, {}, add_leaf(std::move(leaf))};
  }
  return place_file(entry->second, at);
}

Shape Lowerer::place_file(const FileShape& shape, const Place& at) {
  if (shape.leaf) place(*shape.leaf, Vec3(1), at);
  return {shape.dimension, shape.region};
}

}  // namespace lamina::csg
