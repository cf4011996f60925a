#include "base/paths.h"

#include <filesystem>

#include "base/letter_case.h"

namespace lamina {

namespace fs = std::filesystem;

std::string absolute_path(const std::string& path) {
  std::error_code failed;
  const fs::path absolute = fs::absolute(path, failed);
  return (failed ? fs::path(path) : absolute).lexically_normal().string();
}

std::string folder_of(const std::string& path) {
  return fs::path(absolute_path(path)).parent_path().string();
}

std::string relative_path(const std::string& path, const std::string& base) {
  const fs::path absolute_base =
      absolute_path(base.empty() ? fs::current_path().string() : base);
  return fs::path(absolute_path(path)).lexically_relative(absolute_base);
}

std::string shown_path(const std::string& path) {
  if (!fs::path(path).is_absolute()) return path;
  const std::string relative = relative_path(path, "");
  return relative.starts_with("..") ? path : relative;
}

bool is_font(std::string_view file) {
  const std::string end =
      lower_case(file.substr(file.size() < 4 ? 0 : file.size() - 4));
  return end == ".ttf" || end == ".otf";
}

}  // namespace lamina
