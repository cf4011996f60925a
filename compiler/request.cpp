#include "compiler/request.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "base/text.h"
#include "csg/import/mesh_file.h"
#include "slicer/formats/output_format.h"

namespace lamina::compiler {

bool is_imported(const std::string& path) {
  constexpr std::array<std::string_view, 14> kExtensions = {
      ".stl",   ".off",  ".obj", ".ply",  ".amf", ".3mf",  ".dxf",
      ".fcstd", ".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](std::string_view extension) {
                       return slicer::is_named(path, extension);
                     });
}

bool has_parts(const std::string& path) {
  return csg::has_parts(csg::import_format_of_file(path));
}

std::string import_of(const std::string& path, const std::string& part) {
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string of = part.empty() ? "" : ", part = " + in_quotes(part);
  return "import(" + in_quotes(name) + of + ");\n";
}

}  // namespace lamina::compiler
