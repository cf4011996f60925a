#include "csg/lower/detail/cad_file.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"

namespace lamina::csg {
namespace {

cad::Format cad_format(ImportFormat format) {
  return format == ImportFormat::kStep   ? cad::Format::kStep
         : format == ImportFormat::kIges ? cad::Format::kIges
                                         : cad::Format::kBrep;
}

cad::Part read_part(const ImportParams& params, double chordal_error,
                    cad::Reader& reader, const FileAccess& access,
                    SourceRange range) {
  const std::string path(params.path);
  const auto bytes = access.read_regular(path);
  if (!bytes) {
    throw FileError({Severity::kError, range,
                     fmt::format("Can't open import file '{}'", path)});
  }
  try {
    return reader.read(*bytes, cad_format(params.format),
                       {.chordal_error = chordal_error});
  } catch (const FormatError& fault) {
    throw GeometryError(
        {Severity::kError, range,
         fmt::format("{} importing file '{}'", fault.what(), path)});
  }
}

}  // namespace

bool is_cad_format(ImportFormat format) {
  return format == ImportFormat::kStep || format == ImportFormat::kIges ||
         format == ImportFormat::kBrep;
}

std::vector<RawMesh> read_cad_file(const ImportParams& params,
                                   double chordal_error, cad::Reader& reader,
                                   const FileAccess& access, SourceRange range,
                                   Diagnostics& diagnostics) {
  const std::string path(params.path);
  cad::Part part = read_part(params, chordal_error, reader, access, range);
  for (const std::string& words : part.warnings) {
    diagnostics.own_warning(range, fmt::format("{} in '{}'", words, path));
  }
  for (const std::string& words : part.notes) {
    Diagnostic note{Severity::kPlain, range,
                    fmt::format("{} in '{}'", words, path)};
    note.audience = Audience::kTerminal;
    diagnostics.report(std::move(note));
  }
  std::vector<RawMesh> meshes;
  for (cad::Body& body : part.bodies) {
    meshes.push_back({std::move(body.mesh), {}, true});
  }
  return meshes;
}

}  // namespace lamina::csg
