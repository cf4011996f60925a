#include "compiler/parts.h"

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/file/format_error.h"
#include "base/text.h"
#include "csg/import/freecad/freecad_file.h"
#include "csg/import/mesh_file.h"
#include "plane/limits.h"
#include "slicer/formats/output_format.h"

namespace lamina::compiler {
namespace {

bool is_freecad(const std::string& path) {
  return slicer::is_named(path, ".fcstd");
}

std::vector<FilePart> read_parts(const std::string& path,
                                 std::string_view bytes) {
  std::vector<FilePart> parts;
  if (is_freecad(path)) {
    for (csg::FreecadPart& part : csg::freecad_parts(bytes)) {
      const bool has_label = part.label != part.name;
      parts.push_back({std::move(part.name), has_label ? part.label : "",
                       std::move(part.type), part.is_visible});
    }
    return parts;
  }
  for (const csg::ThreemfPart& part : csg::threemf_parts(bytes)) {
    parts.push_back({part.id, part.name,
                     part.triangles == 0
                         ? "made of others"
                         : counted(part.triangles, "triangle", "triangles"),
                     part.count > 0});
  }
  return parts;
}

}  // namespace

bool has_parts(const std::string& path) {
  return is_freecad(path) || slicer::is_named(path, ".3mf");
}

std::vector<FilePart> parts_of(const std::string& path,
                               const FileAccess& access) {
  access.require(path);
  const auto bytes = access.read_regular(path);
  if (!bytes) {
    throw FileError(fmt::format("Can't open input file '{}'!", path));
  }
  std::string fault;
  try {
    return read_parts(path, *bytes);
  } catch (const FormatError& error) {
    fault = error.what();
  } catch (const plane::LimitExceeded& error) {
    fault = error.diagnostic().message;
  }
  throw FileError(fmt::format("{}, reading '{}'", on_one_line(fault), path));
}

}  // namespace lamina::compiler
