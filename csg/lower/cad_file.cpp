#include "csg/lower/detail/cad_file.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/text.h"

namespace lamina::csg {
namespace {

// Returns the name with the entry of an archive as if that were a folder.
std::string shown_name(const ImportParams& params) {
  return params.entry.empty()
             ? std::string(params.path)
             : fmt::format("{}/{}", params.path, on_one_line(params.entry));
}

std::string read_bytes(const ImportParams& params, const FileAccess& access,
                       SourceRange range) {
  auto bytes = access.read_regular(std::string(params.path));
  if (bytes) return std::move(*bytes);
  throw FileError({Severity::kError, range,
                   fmt::format("Can't open import file '{}'", params.path)});
}

cad::Part read_part(const ImportParams& params, double chordal_error,
                    cad::Reader& reader, const FileAccess& access,
                    SourceRange range) {
  const bool is_kept = params.format == ImportFormat::kFcstd;
  const std::string file =
      is_kept ? std::string() : read_bytes(params, access, range);
  try {
    return reader.read(is_kept ? params.boundary : file,
                       cad::format_of(params.format),
                       {.chordal_error = chordal_error}, params.id);
  } catch (const FormatError& fault) {
    throw GeometryError({Severity::kError, range,
                         fmt::format("{} importing file '{}'", fault.what(),
                                     shown_name(params))});
  }
}

}  // namespace

std::vector<RawMesh> read_cad_file(const ImportParams& params,
                                   double chordal_error, cad::Reader& reader,
                                   const FileAccess& access, SourceRange range,
                                   Diagnostics& diagnostics) {
  const std::string name = shown_name(params);
  cad::Part part = read_part(params, chordal_error, reader, access, range);
  for (const std::string& words : part.warnings) {
    diagnostics.own_warning(range, fmt::format("{} in '{}'", words, name));
  }
  for (const std::string& words : part.notes) {
    diagnostics.own_remark(range, fmt::format("{} in '{}'", words, name));
  }
  std::vector<RawMesh> meshes;
  for (cad::Body& body : part.bodies) {
    meshes.push_back({std::move(body.mesh), {}, true});
  }
  return meshes;
}

}  // namespace lamina::csg
