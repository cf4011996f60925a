#include "csg/eval/files.h"

#include <filesystem>

#include <fmt/format.h>
#include <sys/stat.h>

#include "csg/eval/resolver.h"
#include "csg/eval/text.h"

namespace lamina::csg {

namespace fs = std::filesystem;

std::string find_file(std::string_view name, const BuiltinModuleCode& code,
                      Frame& frame) {
  const fs::path own = fs::absolute(code.unit->program->source->path());
  std::string path = find_file(name, own.parent_path().string(), frame.in);
  frame.in.add_file(path);
  return path;
}

std::string find_file(std::string_view name, const std::string& from,
                      Interpreter& in) {
  if (name.empty() || fs::path(name).is_absolute()) return std::string(name);
  const fs::path here = fs::path(from) / name;
  const fs::path fallback = fs::path(in.design_folder()) / name;
  std::error_code ignored;
  if (!fs::exists(here, ignored) && fs::exists(fallback, ignored)) {
    in.deprecate({}, fmt::format("Imported file ({}) found in document root "
                                 "instead of relative to the importing module. "
                                 "This behavior is deprecated",
                                 name));
    return fallback.string();
  }
  return here.string();
}

std::string relative_quoted(const std::string& path, Frame& frame) {
  std::string text;
  std::error_code ignored;
  const fs::path folder =
      fs::weakly_canonical(frame.in.design_folder(), ignored);
  const fs::path file =
      fs::weakly_canonical(path.empty() ? folder : fs::path(path), ignored);
  const std::string relative = file.lexically_relative(folder).generic_string();
  append_quoted(relative == "." ? "./" : relative, text);
  return text;
}

std::string timestamp_text(const std::string& path) {
  struct stat status = {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  return fmt::format("timestamp = {}", exists ? status.st_mtime : 0);
}

}  // namespace lamina::csg
