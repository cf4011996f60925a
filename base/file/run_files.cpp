#include "base/file/run_files.h"

#include <array>

#include <fmt/format.h>

#include "base/file/file_access.h"
#include "base/letter_case.h"
#include "base/paths.h"

namespace lamina {
namespace {

std::uint64_t identity_of(const struct stat& status) {
  const std::array<std::uint64_t, 2> numbers = {status.st_dev, status.st_ino};
  return fingerprint(
      {reinterpret_cast<const char*>(numbers.data()), sizeof(numbers)});
}

// The regular file that an output would replace; of a folder those in it.
//
// there  what stands at `path`
std::vector<std::uint64_t> files_at(const std::string& path,
                                    const std::optional<struct stat>& there,
                                    const FileAccess& access) {
  std::vector<std::uint64_t> files;
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
  return place_of(path, access.is_there(path), access);
}

std::string RunFiles::place_of(const std::string& path, bool is_there,
                               const FileAccess& access) {
  const std::size_t slash = path.rfind('/');
  const std::string folder =
      slash == std::string::npos ? "." : path.substr(0, slash + 1);
  std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const bool is_plain = !name.empty() && name != "." && name != "..";
  if (!is_plain || is_there) return access.weakly_canonical(path);
  // Tables have many outputs in one folder.
  constexpr std::size_t kMostFolders = 10'000;
  const std::lock_guard lock(mutex_);
  if (folders_.size() > kMostFolders) folders_.clear();
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
  expect_place(place_of(path, output.there.has_value(), access), path);
  expect_files(path, output.there, access);
}

bool RunFiles::expect_one_of_many(const std::string& path,
                                  const FileAccess& access) {
  // Where nothing is confined, one look is all that it takes.
  const std::optional<struct stat> there = access.is_confined()
                                               ? access.find_output(path).there
                                               : access.look_at(path);
  const std::string place = place_of(path, there.has_value(), access);
  if (there) expect_files(path, there, access);
  const std::lock_guard lock(mutex_);
  check_place(place, path);
  return many_places_.insert(fingerprint(place));
}

bool RunFiles::expect_of_another_run(const std::string& path,
                                     const FileAccess& access) {
  const std::string place = place_of(path, false, access);
  const std::lock_guard lock(mutex_);
  return many_places_.insert(fingerprint(place));
}

void RunFiles::end_of_many() {
  const std::lock_guard lock(mutex_);
  many_places_ = {};
}

void RunFiles::expect_files(const std::string& path,
                            const std::optional<struct stat>& there,
                            const FileAccess& access) {
  const std::vector<std::uint64_t> files = files_at(path, there, access);
  const std::lock_guard lock(mutex_);
  check_unread(path, files);
  for (const std::uint64_t file : files) outputs_.insert(file);
}

void RunFiles::require_unread(const std::string& path,
                              const FileAccess& access) {
  const std::vector<std::uint64_t> files =
      files_at(path, access.look_at(path), access);
  const std::lock_guard lock(mutex_);
  check_unread(path, files);
}

void RunFiles::check_unread(const std::string& path,
                            const std::vector<std::uint64_t>& files) const {
  for (const std::uint64_t file : files) {
    if (inputs_.contains(file)) refuse_input(path);
  }
}

void RunFiles::expect_place(const std::string& place, const std::string& path) {
  const std::lock_guard lock(mutex_);
  check_place(place, path);
  places_.emplace(place, path);
}

void RunFiles::check_place(const std::string& place,
                           const std::string& path) const {
  const auto known = places_.find(place);
  if (known == places_.end()) return;
  throw FileError(fmt::format(
      "Can't write '{}': '{}', another output of this run, is the same file",
      path, known->second));
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
