#include "base/paths.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/letter_case.h"

namespace lamina {

namespace fs = std::filesystem;

namespace {

// Spellings of the folder from which files are named.
struct Naming {
  std::vector<std::string> absolute;  // as it was given, and without links
  std::vector<std::string> relative;  // from the working folder; end with '/'
};

Naming& naming() {
  static Naming names;
  return names;
}

std::string without_end(std::string folder) {
  while (folder.ends_with('/')) folder.pop_back();
  return folder;
}

// `path` from the folder if that is how it begins. What goes on behind it may
// lead out of it again.
std::optional<std::string> path_below(const std::string& folder,
                                      const std::string& path) {
  if (!path.starts_with(folder)) return std::nullopt;
  if (path.size() == folder.size()) return ".";
  if (path[folder.size()] != '/') return std::nullopt;
  const std::size_t rest = path.find_first_not_of('/', folder.size());
  if (rest == std::string::npos) return ".";
  return fs::path(path.substr(rest)).lexically_normal().string();
}

// Whether it may be part of a name between slashes. Messages put other
// characters around paths: quotes of all kinds, blanks, brackets, colons.
bool is_in_name(char c) {
  const char small = lower_case(c);
  return (small >= 'a' && small <= 'z') || (c >= '0' && c <= '9') ||
         static_cast<unsigned char>(c) >= 0x80 || c == '_' || c == '-' ||
         c == '.';
}

bool may_begin_absolute(std::string_view before) {
  return before.empty() || !is_in_name(before.back());
}

// A relative path is like any words unless it is quoted.
bool may_begin_relative(std::string_view before) {
  return before.empty() || before.back() == '\'' || before.back() == '"';
}

// Takes `folder` out of the text wherever a path begins with it.
std::string without_folder(const std::string& text, const std::string& folder,
                           bool (*may_begin)(std::string_view before)) {
  std::string told;
  std::size_t done = 0;
  for (std::size_t at = text.find(folder); at != std::string::npos;
       at = text.find(folder, std::max(at + 1, done))) {
    const std::size_t end = at + folder.size();
    const bool goes_on =
        !folder.ends_with('/') && end < text.size() && is_in_name(text[end]);
    if (goes_on || !may_begin(std::string_view(text).substr(0, at))) continue;
    told.append(text, done, at - done);
    done = std::min(text.find_first_not_of('/', end), text.size());
    if (text[done - 1] != '/') told += '.';
  }
  return told.append(text, done);
}

// From the folder of name_files_from(); no value where it does not lie there.
std::optional<std::string> path_in_folder(const std::string& path) {
  if (path.empty() || path == "-") return std::nullopt;
  for (const std::string& folder : naming().absolute) {
    std::error_code error;
    for (const std::string& absolute :
         {fs::absolute(path, error).string(), absolute_path(path)}) {
      if (auto below = path_below(folder, absolute)) return below;
    }
  }
  return std::nullopt;
}

std::string lexically_relative(const std::string& path,
                               const std::string& base) {
  const std::string from = base.empty() ? "." : base;
  return fs::path(absolute_path(path)).lexically_relative(absolute_path(from));
}

}  // namespace

std::string absolute_path(const std::string& path) {
  std::error_code failed;
  const fs::path absolute = fs::absolute(path, failed);
  return (failed ? fs::path(path) : absolute).lexically_normal().string();
}

std::string folder_of(const std::string& path) {
  return fs::path(absolute_path(path)).parent_path().string();
}

void name_files_from(const std::string& folder, const std::string& canonical) {
  std::error_code error;
  for (const std::string& path : {fs::absolute(folder, error).string(),
                                  absolute_path(folder), canonical}) {
    std::string absolute = without_end(path);
    const bool is_known = std::ranges::find(naming().absolute, absolute) !=
                          naming().absolute.end();
    if (absolute.empty() || is_known) continue;  // "/" names nothing
    std::string relative = lexically_relative(absolute, "");
    // Where the working folder lies in this one, no name begins with it.
    if (relative != "." && !relative.ends_with("..")) {
      naming().relative.push_back(relative + '/');
    }
    naming().absolute.push_back(std::move(absolute));
  }
}

std::string display_path(const std::string& path) {
  return path_in_folder(path).value_or(path);
}

std::string relative_path(const std::string& path, const std::string& base) {
  const auto told = path_in_folder(path);
  const auto told_base = path_in_folder(base);
  return told && told_base ? lexically_relative(*told, *told_base)
                           : lexically_relative(path, base);
}

std::string shown_path(const std::string& given) {
  std::string path = display_path(given);
  if (!fs::path(path).is_absolute()) return path;
  const std::string relative = lexically_relative(path, "");
  return relative.starts_with("..") ? path : relative;
}

std::string path_of_shown(const std::string& shown) {
  if (naming().absolute.empty()) return shown;
  return (fs::path(naming().absolute.front()) / shown).string();
}

std::string quoted_path(std::string_view path) {
  return fmt::format("\"{}\"", fs::path(display_path(std::string(path)))
                                   .lexically_proximate(fs::current_path())
                                   .generic_string());
}

std::string with_display_paths(std::string text) {
  for (const std::string& folder : naming().absolute) {
    text = without_folder(text, folder, may_begin_absolute);
  }
  for (const std::string& folder : naming().relative) {
    text = without_folder(text, folder, may_begin_relative);
  }
  return text;
}

bool is_font(std::string_view file) {
  const std::string end =
      lower_case(file.substr(file.size() < 4 ? 0 : file.size() - 4));
  return end == ".ttf" || end == ".otf";
}

}  // namespace lamina
