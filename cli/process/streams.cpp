#include "cli/process/streams.h"

#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "base/file/write_all.h"
#include "base/paths.h"
#include "base/text.h"

namespace lamina::cli {
namespace {

// As the folder was given and without links; each ends with '/'.
std::vector<std::string>& folder_names() {
  static std::vector<std::string> names;
  return names;
}

// Whether a path may go on after it.
bool is_in_path(char c) {
  return std::string_view(" '\"(=\n").find(c) == std::string_view::npos;
}

}  // namespace

void open_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest number that is free is this one.
    if (::open("/", O_PATH) < 0) return;
  }
}

void name_files_from(const std::string& folder) {
  std::error_code error;
  const std::filesystem::path canonical =
      std::filesystem::weakly_canonical(folder, error);
  for (std::string name : {absolute_path(folder), canonical.string()}) {
    if (!name.ends_with('/')) name += '/';
    if (name != "/") folder_names().push_back(std::move(name));
  }
}

std::string with_short_paths(std::string text) {
  for (const std::string& name : folder_names()) {
    for (std::size_t at = text.find(name); at != std::string::npos;
         at = text.find(name, at)) {
      if (at > 0 && is_in_path(text[at - 1])) {
        ++at;  // the end of another folder's name
      } else {
        text.erase(at, name.size());
      }
    }
  }
  return text;
}

void print_out(std::string_view text) {
  const int error = write_all(STDOUT_FILENO, without_controls(text));
  if (error == 0) return;
  throw FileError(
      fmt::format("Can't write 'standard output': {}", std::strerror(error)));
}

void print_error(std::string_view text) { write_all(STDERR_FILENO, text); }

}  // namespace lamina::cli
