#include "base/file/output_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "base/file/open_file.h"

namespace lamina {

namespace fs = std::filesystem;

namespace {

using Words = std::unordered_set<std::string>;

// What stands between quotes in a file of contents: the names of the files that
// it lists, and its own. None if lamina did not write it.
Words words_of(const fs::path& contents, FileAccess access) {
  access.report_to(nullptr);  // it is read to be replaced
  std::istringstream file(access.read(contents).value_or(""));
  Words words;
  for (std::string word; std::getline(file, word, '"');) words.insert(word);
  const bool is_own = std::any_of(
      words.begin(), words.end(),
      [](const std::string& word) { return word.starts_with("lamina "); });
  if (!is_own) return {};
  words.insert(contents.filename());
  return words;
}

[[noreturn]] void fail(const std::string& path, std::string_view fault) {
  throw FileError(fmt::format("Can't write '{}': {}", path, fault));
}

// Throws where something stands at the target that lamina did not make.
void check_target(const std::string& path, const std::string& contents,
                  const FileAccess& access) {
  const OutputPlace place = access.find_output(path);
  if (!place.there) return;
  if (!S_ISDIR(place.there->st_mode)) fail(path, "it is no folder");
  const Words own = words_of(fs::path(path) / contents, access);
  const auto names = access.list(path);
  if (!names) fail(path, std::strerror(errno));
  for (const std::string& name : *names) {
    if (!own.contains(name)) {
      fail(path, fmt::format(
                     "a folder stands there, and '{}' in it, which lamina did "
                     "not make, would be lost",
                     name));
    }
  }
}

}  // namespace

OutputFolder OutputFolder::open(std::string path, std::string contents,
                                TemporaryFiles& temporary_files) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  if (path == "-") fail(path, "standard output takes no folder");
  check_target(path, contents, temporary_files.file_access());
  TemporaryFiles::Folder temporary = temporary_files.make_folder(path);
  if (temporary.lock < 0) fail(path, std::strerror(errno));
  return {std::move(path), std::move(contents), temporary_files,
          std::move(temporary)};
}

OutputFolder::~OutputFolder() { temporary_files_.discard_folder(temporary_); }

void OutputFolder::add(const std::string& name, std::string_view bytes) {
  const int file = temporary_files_.open_file_in(temporary_, name);
  if (file < 0) fail(path_, std::strerror(errno));
  int error = write_all(file, bytes);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error != 0) fail(path_, std::strerror(error));
  size_ += bytes.size();
}

void OutputFolder::commit() {
  check_target(path_, contents_, temporary_files_.file_access());
  if (!temporary_files_.commit_folder(temporary_, path_)) {
    fail(path_, std::strerror(errno));
  }
}

}  // namespace lamina
