#include "csg/import/mesh_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "base/check.h"
#include "base/file/format_error.h"
#include "base/letter_case.h"
#include "base/text.h"

namespace lamina::csg {
namespace {

Placing placing_of(const ImportParams& params) {
  if (params.is_design) return Placing::kFile;
  return params.rules == Language::k2021 ? Placing::kNone : Placing::kOpenScad;
}

// A page that a browser saved in place of the file that it links to.
bool is_web_page(std::string_view bytes) {
  constexpr std::size_t kHead = 64;
  const std::string head = lower_case(trim(bytes.substr(0, kHead)));
  return head.starts_with("<!doctype html") || head.starts_with("<html");
}

PlacedMeshes parse(std::string_view bytes, const ImportParams& params) {
  if (is_web_page(bytes)) throw FormatError("a web page in place of a mesh");
  PlacedMeshes meshes;
  std::vector<RawMesh>& bodies = meshes.bodies;
  switch (params.format) {
    case ImportFormat::kStl:
      bodies.push_back(parse_stl(bytes));
      break;
    case ImportFormat::kOff:
      bodies.push_back(parse_off(bytes));
      break;
    case ImportFormat::kObj:
      bodies.push_back(parse_obj(bytes));
      break;
    case ImportFormat::kPly:
      bodies.push_back(parse_ply(bytes));
      break;
    case ImportFormat::kAmf:
      return parse_amf(bytes, std::filesystem::path(params.path).filename(),
                       placing_of(params));
    case ImportFormat::k3mf:
      return parse_3mf(bytes, placing_of(params), params.id);
    case ImportFormat::kUnknown:
    case ImportFormat::kDxf:
    case ImportFormat::kSvg:
    case ImportFormat::kStep:
    case ImportFormat::kIges:
    case ImportFormat::kBrep:
    case ImportFormat::kFcstd:
      break;
  }
  return meshes;
}

}  // namespace

std::string at_import(SourceRange range) {
  return range.is_written()
             ? fmt::format(", import() at line {}", range.openscad_line())
             : std::string();
}

namespace {

// The warnings in the words of OpenSCAD, which differ from format to format.
std::string warning_text(std::string_view words, const std::string& path,
                         SourceRange range) {
  return fmt::format("{} '{}'{}", words, path, at_import(range));
}

void report_broken(const std::string& path, ImportFormat format,
                   const FormatError& fault, SourceRange range,
                   Diagnostics& diagnostics) {
  if (format != ImportFormat::kAmf && format != ImportFormat::k3mf) {
    diagnostics.error(
        range, fmt::format("{} importing file '{}'", fault.what(), path));
    return;
  }
  diagnostics.report(
      {Severity::kWarning,
       range,
       warning_text(format == ImportFormat::k3mf ? "Could not read file"
                                                 : "Failed to parse file",
                    path, range),
       {},
       {{range, fault.what()}}});
}

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Drops the faces with a corner that is not finite; returns their number.
std::size_t drop_infinite(RawMesh& raw) {
  auto& vertices = raw.mesh.vertices;
  if (std::all_of(vertices.begin(), vertices.end(), is_finite)) return 0;
  const auto is_bad = [&vertices](const auto& face) {
    return std::any_of(face.begin(), face.end(), [&](std::uint32_t corner) {
      return !is_finite(vertices[corner]);
    });
  };
  const std::size_t dropped = std::erase_if(raw.mesh.triangles, is_bad) +
                              std::erase_if(raw.polygons, is_bad);
  for (Vec3& vertex : vertices) {
    if (!is_finite(vertex)) vertex = Vec3(0);  // no face's any more
  }
  raw.is_joined = false;
  return dropped;
}

}  // namespace

std::size_t RawMesh::count_stray_corners() const {
  std::size_t count = 0;
  const auto count_in = [&](const auto& face) {
    for (const std::uint32_t corner : face) {
      count += corner < mesh.vertices.size() ? 0 : 1;
    }
  };
  for (const auto& triangle : mesh.triangles) count_in(triangle);
  for (const auto& polygon : polygons) count_in(polygon);
  return count;
}

ImportFormat import_format_of(std::string_view extension) {
  if (extension.starts_with('.')) extension.remove_prefix(1);
  static const std::map<std::string_view, ImportFormat> kFormats = {
      {"stl", ImportFormat::kStl},     {"off", ImportFormat::kOff},
      {"obj", ImportFormat::kObj},     {"ply", ImportFormat::kPly},
      {"amf", ImportFormat::kAmf},     {"3mf", ImportFormat::k3mf},
      {"dxf", ImportFormat::kDxf},     {"svg", ImportFormat::kSvg},
      {"fcstd", ImportFormat::kFcstd}, {"step", ImportFormat::kStep},
      {"stp", ImportFormat::kStep},    {"iges", ImportFormat::kIges},
      {"igs", ImportFormat::kIges},    {"brep", ImportFormat::kBrep},
      {"brp", ImportFormat::kBrep}};
  const auto found = kFormats.find(lower_case(extension));
  return found == kFormats.end() ? ImportFormat::kUnknown : found->second;
}

ImportFormat import_format_of_file(const std::string& path) {
  return import_format_of(std::filesystem::path(path).extension().string());
}

bool is_mesh(ImportFormat format) {
  switch (format) {
    case ImportFormat::kStl:
    case ImportFormat::kOff:
    case ImportFormat::kObj:
    case ImportFormat::kPly:
    case ImportFormat::kAmf:
    case ImportFormat::k3mf:
      return true;
    default:
      return false;
  }
}

bool is_cad(ImportFormat format) {
  return format == ImportFormat::kStep || format == ImportFormat::kIges ||
         format == ImportFormat::kBrep || format == ImportFormat::kFcstd;
}

bool has_parts(ImportFormat format) {
  return format == ImportFormat::k3mf || is_cad(format);
}

std::vector<RawMesh> read_mesh_file(const ImportParams& params,
                                    const FileAccess& access, SourceRange range,
                                    Diagnostics& diagnostics) {
  const std::string path(params.path);
  const ImportFormat format = params.format;
  const auto bytes = access.read_regular(path);
  if (!bytes) {
    const std::string reason = words_of_open_fault(errno);
    Diagnostic missing{
        Severity::kWarning, range,
        warning_text(format == ImportFormat::k3mf ? "Could not read file"
                                                  : "Can't open import file",
                     path, range)};
    missing.hints = hint_of(reason);
    diagnostics.report(std::move(missing));
    return {};
  }
  PlacedMeshes meshes;
  try {
    meshes = parse(*bytes, params);
  } catch (const FormatError& fault) {
    report_broken(path, format, fault, range, diagnostics);
    return {};
  }
  for (const std::string& words : meshes.passed_over) {
    diagnostics.warning(
        range, fmt::format("'{}' {}{}", path, words, at_import(range)));
  }
  std::vector<RawMesh>& bodies = meshes.bodies;
  if (std::any_of(bodies.begin(), bodies.end(),
                  [](const RawMesh& raw) { return raw.is_stand_in; })) {
    if (params.is_design) {
      throw GeometryError(
          {Severity::kError, range,
           fmt::format("'{0}' holds layers already, and its mesh is only a "
                       "placeholder; try 'lamina inspect {0}'",
                       path)});
    }
    diagnostics.warning(
        range,
        fmt::format("'{}' holds its part as slices, and its mesh is only a "
                    "placeholder{}",
                    path, at_import(range)));
  }
  for (const RawMesh& raw : bodies) {
    LAMINA_CHECK_EQ(raw.count_stray_corners(), 0U);
  }
  std::size_t dropped = 0;
  for (RawMesh& raw : bodies) dropped += drop_infinite(raw);
  if (dropped > 0) {
    diagnostics.warning(range,
                        fmt::format("Dropped {} facets whose coordinates are "
                                    "no numbers, of file '{}'",
                                    dropped, path));
  }
  return std::move(meshes.bodies);
}

}  // namespace lamina::csg
