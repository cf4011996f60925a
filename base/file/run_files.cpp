#include "base/file/run_files.h"

#include <optional>

#include <fmt/format.h>

#include "base/file/file_access.h"
#include "base/letter_case.h"
#include "base/paths.h"

namespace lamina {
namespace {

using Identity = RunFiles::Identity;

Identity identity_of(const struct stat& status) {
  return {status.st_dev, status.st_ino};
}

// The regular file that an output would replace; of a folder those in it.
//
// there  what stands at `path`
std::vector<Identity> files_at(const std::string& path,
                               const std::optional<struct stat>& there,
                               const FileAccess& access) {
  std::vector<Identity> files;
  const auto add = [&](const std::optional<struct stat>& status) {
    if (status && S_ISREG(status->st_mode)) {
      files.push_back(identity_of(*status));
    }
  };
  add(there);
  if (!there || !S_ISDIR(there->st_mode)) return files;
  for (const std::string& name :
       access.list(path).value_or(std::vector<std::string>())) {
    add(access.look_at(path + "/" + name));
  }
  return files;
}

[[noreturn]] void refuse_input(const std::string& path) {
  throw FileError(fmt::format(
      "Can't write '{}': this run reads it, too; give the output another name",
      shown_path(path)));
}

}  // namespace

std::string RunFiles::place_of(const std::string& path,
                               const FileAccess& access) {
  const std::size_t slash = path.rfind('/');
  const std::string folder =
      slash == std::string::npos ? "." : path.substr(0, slash + 1);
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const bool is_plain = !name.empty() && name != "." && name != "..";
  if (!is_plain || access.is_there(path)) return access.weakly_canonical(path);
  // Tables have many outputs in one folder.
  const std::lock_guard lock(mutex_);
  const auto [known, is_new] = folders_.try_emplace(folder);
  if (is_new) {
    known->second = {access.weakly_canonical(folder),
                     access.folds_case(folder)};
    if (!known->second.path.ends_with('/')) known->second.path += '/';
  }
  return known->second.path +
         (known->second.folds_case ? lower_case(name) : name);
}

void RunFiles::expect_output(std::string path, const FileAccess& access) {
  if (path.empty()) return;
  if (path == "-") return expect_place(path, path);
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  const OutputPlace output = access.find_output(path);
  if (output.there && !S_ISREG(output.there->st_mode) &&
      !S_ISDIR(output.there->st_mode)) {
    return;  // a device or a pipe, which takes what comes
  }
  expect_place(place_of(path, access), path);
  const std::vector<Identity> files = files_at(path, output.there, access);
  const std::lock_guard lock(mutex_);
  check_unread(path, files);
  outputs_.insert(files.begin(), files.end());
}

void RunFiles::require_unread(const std::string& path,
                              const FileAccess& access) {
  const std::vector<Identity> files =
      files_at(path, access.look_at(path), access);
  const std::lock_guard lock(mutex_);
  check_unread(path, files);
}

void RunFiles::check_unread(const std::string& path,
                            const std::vector<Identity>& files) const {
  for (const Identity& file : files) {
    if (inputs_.contains(file)) refuse_input(path);
  }
}

void RunFiles::expect_place(const std::string& place, const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto [known, is_new] = places_.try_emplace(place, path);
  if (!is_new) {
    throw FileError(fmt::format(
        "Can't write '{}': '{}', another output of this run, is the same file",
        path, known->second));
  }
}

void RunFiles::note_input(const std::string& path, const struct stat& status) {
  const std::lock_guard lock(mutex_);
  if (outputs_.contains(identity_of(status))) refuse_input(path);
  inputs_.insert(identity_of(status));
}

void RunFiles::note_written(const struct stat* before, const struct stat& now) {
  const std::lock_guard lock(mutex_);
  if (before != nullptr) outputs_.erase(identity_of(*before));
  outputs_.insert(identity_of(now));
}

}  // namespace lamina
