#include "csg/eval/builtin/file_paths.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "csg/eval/builtin/conversions.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace fs = std::filesystem;

std::string find_file(std::string_view name, const ModuleCall& call) {
  const fs::path own = fs::absolute(call.code.unit->source->path());
  std::string path =
      find_file(name, own.parent_path().string(), call.code.range, call.in);
  call.in.add_file(path);
  return path;
}

std::string find_file(std::string_view name, const std::string& from,
                      SourceRange place, Interpreter& in) {
  if (name.empty()) return "";
  const FileAccess& access = in.file_access();
  const fs::path here = fs::path(from) / name;  // name, where it is absolute
  access.require(here, name, place, FileUse::kData);
  if (fs::path(name).is_absolute()) return std::string(name);
  const fs::path fallback = fs::path(in.design_folder()) / name;
  if (!access.is_there(here) && access.is_there(fallback)) {
    in.deprecate(
        {}, fmt::format(
                "Imported file ({}) found in document root instead of relative "
                "to the importing module. This behavior is deprecated",
                name));
    return fallback.string();
  }
  return here.string();
}

std::string relative_path(const std::string& path, Frame& frame) {
  if (path.empty()) return "";
  const FileAccess& access = frame.in.file_access();
  const fs::path folder = access.weakly_canonical(frame.in.design_folder());
  const fs::path file = access.weakly_canonical(path);
  const std::string relative = file.lexically_relative(folder).generic_string();
  return relative == "." ? "./" : relative;
}

std::string relative_quoted(const std::string& path, Frame& frame) {
  return in_quotes(relative_path(path, frame));
}

Vec2 read_origin(const Value& origin, std::string_view shown_name,
                 const ModuleCall& call) {
  const std::optional<Vec2> given = to_vec2(origin);
  const bool is_fine =
      given && std::isfinite(given->x) && std::isfinite(given->y);
  if (!origin.is_undef() && !is_fine) {
    if (call.in.language() == Language::k2021) {
      call.warn("{}(..., origin={}) could not be converted", shown_name,
                to_echo(origin));
    } else {
      call.warn("Unable to convert {}(..., origin={}) parameter to vec2",
                call.code.name, to_echo(origin));
    }
  }
  return given.value_or(Vec2(0.0));
}

std::string drawing_text(const ImportParams& drawing, Frame& frame) {
  return fmt::format("file = {}, layer = {}, origin = [{:g}, {:g}], ",
                     relative_quoted(std::string(drawing.path), frame),
                     in_quotes(drawing.layer.value_or("")), drawing.origin.x,
                     drawing.origin.y);
}

std::string timestamp_text(const std::string& path, Frame& frame) {
  const auto status = frame.in.file_access().look_at(path);
  return fmt::format("timestamp = {}", status ? status->st_mtime : 0);
}

}  // namespace lamina::csg
