#include "csg/lower/detail/cad_file.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/file/zip.h"

namespace lamina::csg {
namespace {

cad::Format cad_format(ImportFormat format) {
  return format == ImportFormat::kStep   ? cad::Format::kStep
         : format == ImportFormat::kIges ? cad::Format::kIges
                                         : cad::Format::kBrep;
}

std::string unpack(std::string_view archive, const std::string& entry) {
  auto bytes = ZipArchive::open(archive).read(entry);
  if (!bytes) throw FormatError(fmt::format("FCStd holds no '{}'", entry));
  return std::move(*bytes);
}

}  // namespace

bool is_cad_format(ImportFormat format) {
  return format == ImportFormat::kStep || format == ImportFormat::kIges ||
         format == ImportFormat::kBrep || format == ImportFormat::kFcstd;
}

std::vector<RawMesh> read_cad_file(const ImportParams& params,
                                   double chordal_error, cad::Reader& reader,
                                   const FileAccess& access, SourceRange range,
                                   Diagnostics& diagnostics) {
  const std::string path(params.path);
  auto bytes = access.read_regular(path);
  if (!bytes) {
    diagnostics.error(range,
                      fmt::format("Can't open import file '{}', import() at "
                                  "line {}",
                                  path, range.openscad_line()));
    return {};
  }
  cad::Part part;
  try {
    if (params.format == ImportFormat::kFcstd) {
      bytes = unpack(*bytes, std::string(params.entry));
    }
    part = reader.read(*bytes, cad_format(params.format),
                       {.chordal_error = chordal_error});
  } catch (const FormatError& fault) {
    diagnostics.error(
        range, fmt::format("{} importing file '{}'", fault.what(), path));
    return {};
  }
  for (const std::string& words : part.warnings) {
    diagnostics.own_warning(
        range, fmt::format("{} in '{}{}{}'", words, path,
                           params.entry.empty() ? "" : "/", params.entry));
  }
  std::vector<RawMesh> meshes;
  for (cad::Body& body : part.bodies) {
    meshes.push_back({std::move(body.mesh), {}, true});
  }
  return meshes;
}

}  // namespace lamina::csg
