#include "compiler/request.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "slicer/formats/output_format.h"

namespace lamina::compiler {

bool is_imported(const std::string& path) {
  constexpr std::array<std::string_view, 15> kExtensions = {
      ".stl",   ".off",  ".obj", ".ply",  ".om",  ".amf",  ".3mf", ".dxf",
      ".fcstd", ".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](std::string_view extension) {
                       return slicer::is_named(path, extension);
                     });
}

std::string import_of(const std::string& path) {
  std::string text = "import(\"";
  for (const char c : std::filesystem::path(path).filename().string()) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\");\n";
}

}  // namespace lamina::compiler
