#include "cli/imported_design.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace lamina::cli {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

bool is_imported(const std::string& path) {
  constexpr std::array<std::string_view, 6> kExtensions = {
      ".stl", ".off", ".obj", ".amf", ".3mf", ".dxf"};
  return std::find(kExtensions.begin(), kExtensions.end(),
                   lower_extension(path)) != kExtensions.end();
}

std::string import_of(const std::string& path) {
  std::string text = "import(\"";
  for (const char c : std::filesystem::path(path).filename().string()) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\");\n";
}

}  // namespace lamina::cli
