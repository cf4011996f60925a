#include "slicer/formats/output_folder.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "parser/diagnostic.h"

namespace lamina::slicer {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(std::string path, std::string contents,
                           TemporaryFiles& temporary_files)
    : path_(std::move(path)),
      contents_(std::move(contents)),
      temporary_files_(temporary_files) {
  while (path_.size() > 1 && path_.ends_with('/')) path_.pop_back();
  if (path_ == "-") fail("standard output takes no folder");
  check_target();
  temporary_path_ = temporary_files_.make_folder(path_);
  if (temporary_path_.empty()) fail(std::strerror(errno));
}

OutputFolder::~OutputFolder() {
  if (!temporary_path_.empty()) temporary_files_.discard(temporary_path_);
}

// Throws where something stands at the target that lamina did not make.
void OutputFolder::check_target() const {
  std::error_code unreadable;
  const fs::file_status status = fs::status(path_, unreadable);
  if (!fs::exists(status)) {
    if (fs::is_symlink(fs::symlink_status(path_, unreadable))) {
      fail("it links to what is not there");
    }
    return;
  }
  if (!fs::is_directory(status)) fail("it is no folder");
  if (fs::is_empty(path_, unreadable)) return;
  if (!fs::exists(fs::path(path_) / contents_, unreadable)) {
    fail(fmt::format("a folder without {} stands there; it would be lost",
                     contents_));
  }
}

void OutputFolder::add(const std::string& name, std::string_view bytes) {
  std::FILE* const file = temporary_files_.open_file_in(temporary_path_, name);
  if (file == nullptr) fail(std::strerror(errno));
  const bool is_written =
      std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int error = errno;
  if (std::fclose(file) != 0) fail(std::strerror(errno));
  if (!is_written) fail(std::strerror(error));
  size_ += bytes.size();
}

void OutputFolder::commit() {
  check_target();
  if (!temporary_files_.commit_folder(temporary_path_, path_)) {
    fail(std::strerror(errno));
  }
  temporary_path_.clear();
}

void OutputFolder::fail(std::string_view fault) const {
  throw FileError({Severity::kError,
                   {},
                   fmt::format("Can't write '{}': {}", path_, fault),
                   {}});
}

}  // namespace lamina::slicer
