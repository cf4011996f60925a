#include "base/file/run_files.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <locale.h>
#include <unistd.h>
#include <wctype.h>

#include "base/file/file_access.h"
#include "base/file/temporary_files.h"
#include "base/letter_case.h"
#include "base/paths.h"
#include "base/utf8.h"

namespace lamina {
namespace {

constexpr const char* kStandardOutput = "-";

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
    add(access.look_at(fmt::format("{}/{}", path, name)));
  }
  return files;
}

// Returns the files that an output at that path would replace now.
std::vector<std::uint64_t> files_of(const std::string& path,
                                    const FileAccess& access) {
  if (path != kStandardOutput) {
    return files_at(path, access.look_at(path), access);
  }
  struct stat status {};
  const bool is_file =
      ::fstat(STDOUT_FILENO, &status) == 0 && S_ISREG(status.st_mode);
  return is_file ? std::vector{identity_of(status)}
                 : std::vector<std::uint64_t>();
}

bool have_one_in_common(const std::vector<std::uint64_t>& a,
                        const std::vector<std::uint64_t>& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

// Returns one spelling for paths that are equal where letters have no case:
// small ones, without points at the end of a name, which FAT leaves out. (By
// letter: where a file system takes two spellings of a letter for one, or "ß"
// for "ss", these stay different.)
std::string without_case(std::string_view path) {
  static const locale_t unicode =
      ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  std::string folded;
  while (!path.empty()) {
    const std::size_t length = std::max<std::size_t>(character_length(path), 1);
    const bool is_letter =
        length > 1 && unicode != nullptr &&
        append_utf8(::towlower_l(first_code_point(path), unicode), folded);
    if (!is_letter) folded += lower_case(path.substr(0, length));
    path.remove_prefix(length);
    if (path.empty() || path.front() == '/') {
      while (folded.ends_with('.')) folded.pop_back();
    }
  }
  return folded;
}

// The folder of that name, or what there is around it.
std::string nearest_folder(std::string folder, const FileAccess& access) {
  while (folder.size() > 1 && !access.is_there(folder)) {
    folder.resize(std::max<std::size_t>(folder.rfind('/'), 1));
  }
  return folder;
}

std::string name_of(const std::string& output) {
  return output == kStandardOutput ? "standard output" : shown_path(output);
}

[[noreturn]] void refuse(const std::string& path, std::string_view why) {
  throw FileError(fmt::format("Can't write '{}': {}", name_of(path), why));
}

[[noreturn]] void refuse_input(const std::string& path) {
  refuse(path, "this run reads it, too; give the output another name");
}

[[noreturn]] void refuse_output(const std::string& path,
                                const std::string& other,
                                std::string_view what) {
  refuse(path, fmt::format("'{}', another output of this run, {}",
                           name_of(other), what));
}

void refuse_hidden_name(const std::string& path) {
  if (!is_hidden_name(path)) return;
  refuse(path, "names such as '.x.lamina-0' are kept for unfinished outputs");
}

constexpr std::string_view kIsTheSameFile = "is the same file";

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
  const std::string name =
      slash == std::string::npos ? path : path.substr(slash + 1);
  const bool is_plain = !name.empty() && name != "." && name != "..";
  const auto folder_of = [&](const std::string& path_of_folder) -> Folder& {
    // Tables have many outputs in one folder.
    constexpr std::size_t kMostFolders = 10'000;
    if (folders_.size() > kMostFolders) folders_.clear();
    const auto [known, is_new] = folders_.try_emplace(path_of_folder);
    if (is_new) {
      known->second.path = access.weakly_canonical(path_of_folder);
      known->second.folds_case =
          access.folds_case(nearest_folder(known->second.path, access));
      if (!known->second.path.ends_with('/')) known->second.path += '/';
    }
    return known->second;
  };
  const std::lock_guard lock(mutex_);
  std::string place;
  bool folds_case = false;
  if (is_plain && !is_there && !access.is_link(path)) {
    const Folder& found = folder_of(folder);
    place = found.path + name;
    folds_case = found.folds_case;
  } else {
    place = access.weakly_canonical(path);
    const std::size_t end = place.rfind('/');
    folds_case = end != std::string::npos &&
                 folder_of(place.substr(0, end + 1)).folds_case;
  }
  return folds_case ? without_case(place) : place;
}

void RunFiles::expect_output(std::string path, const FileAccess& access) {
  if (path.empty()) return;
  if (path == kStandardOutput) {
    expect_standard_output(access);
    return expect_place(path, path);
  }
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  refuse_hidden_name(path);
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
  refuse_hidden_name(path);
  // Where nothing is confined, one look is all that it takes.
  const std::optional<struct stat> there = access.is_confined()
                                               ? access.find_output(path).there
                                               : access.look_at(path);
  const std::string place = place_of(path, there.has_value(), access);
  if (there) expect_files(path, there, access);
  const std::lock_guard lock(mutex_);
  claim_place(place, path);
  return many_places_.insert(fingerprint(place));
}

bool RunFiles::expect_of_another_run(const std::string& path,
                                     const FileAccess& access) {
  const std::string place = place_of(path, false, access);
  const std::lock_guard lock(mutex_);
  claim_place(place, path);
  return many_places_.insert(fingerprint(place));
}

void RunFiles::end_of_many() {
  const std::lock_guard lock(mutex_);
  many_places_ = {};
  around_ = {};
}

void RunFiles::expect_files(const std::string& path,
                            const std::optional<struct stat>& there,
                            const FileAccess& access) {
  const std::vector<std::uint64_t> files = files_at(path, there, access);
  const std::lock_guard lock(mutex_);
  check_unread(path, files);
  // Bytes of standard output go into the file that stands there, and would be
  // lost with it.
  if (places_.contains(kStandardOutput) &&
      have_one_in_common(files, files_of(kStandardOutput, access))) {
    refuse_output(path, kStandardOutput, kIsTheSameFile);
  }
  for (const std::uint64_t file : files) outputs_.insert(file);
}

void RunFiles::expect_standard_output(const FileAccess& access) {
  const std::vector<std::uint64_t> files = files_of(kStandardOutput, access);
  const std::lock_guard lock(mutex_);
  check_unread(kStandardOutput, files);
  for (const auto& [place, path] : places_) {
    if (have_one_in_common(files, files_of(path, access))) {
      refuse_output(kStandardOutput, path, kIsTheSameFile);
    }
  }
  for (const std::uint64_t file : files) outputs_.insert(file);
}

std::vector<std::uint64_t> RunFiles::require_unread(
    const std::string& path, const std::optional<struct stat>& there,
    const FileAccess& access) {
  std::vector<std::uint64_t> files = files_at(path, there, access);
  const std::lock_guard lock(mutex_);
  check_unread(path, files);
  return files;
}

void RunFiles::check_unread(const std::string& path,
                            const std::vector<std::uint64_t>& files) const {
  for (const std::uint64_t file : files) {
    if (inputs_.contains(file)) refuse_input(path);
  }
}

void RunFiles::expect_place(const std::string& place, const std::string& path) {
  const std::lock_guard lock(mutex_);
  claim_place(place, path);
  places_.emplace(place, path);
}

void RunFiles::claim_place(const std::string& place, const std::string& path) {
  const auto refuse_if_output = [&](const std::string& other,
                                    std::string_view what) {
    const auto known = places_.find(other);
    if (known != places_.end()) refuse_output(path, known->second, what);
  };
  refuse_if_output(place, kIsTheSameFile);
  if (around_.contains(fingerprint(place))) {
    refuse(path, "another output of this run would lie inside of it");
  }
  // What is around others is not an output. (Many outputs never lie in others:
  // their names have no '/'.)
  std::vector<std::uint64_t> folders;
  for (std::size_t end = place.rfind('/'); end != std::string::npos && end > 0;
       end = place.rfind('/', end - 1)) {
    const std::string folder = place.substr(0, end);
    const std::uint64_t print = fingerprint(folder);
    if (around_.contains(print)) break;
    refuse_if_output(folder, "would be a folder around it");
    folders.push_back(print);
  }
  for (const std::uint64_t folder : folders) around_.insert(folder);
}

void RunFiles::note_input(const std::string& path, const struct stat& status,
                          const FileAccess& access) {
  const std::uint64_t file = identity_of(status);
  const std::lock_guard lock(mutex_);
  const bool is_output = outputs_.contains(file);
  if (!is_output || !access.is_confined()) inputs_.insert(file);
  if (is_output) refuse_input(path);
}

bool RunFiles::is_input(const struct stat& status) {
  const std::lock_guard lock(mutex_);
  return inputs_.contains(identity_of(status));
}

void RunFiles::begin_again(const FileAccess& access) {
  const std::lock_guard lock(mutex_);
  inputs_ = {};
  outputs_ = {};
  for (const auto& [place, path] : places_) {
    for (const std::uint64_t file : files_of(path, access)) {
      outputs_.insert(file);
    }
  }
}

void RunFiles::note_written(const std::vector<std::uint64_t>& before,
                            const std::string& path, const struct stat& now,
                            const FileAccess& access) {
  const std::vector<std::uint64_t> files = files_at(path, now, access);
  const std::lock_guard lock(mutex_);
  for (const std::uint64_t file : before) outputs_.erase(file);
  for (const std::uint64_t file : files) {
    outputs_.insert(file);
    inputs_.erase(file);  // the number of a file that is gone has come back
  }
}

}  // namespace lamina
