#include "base/file/append_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "base/file/detail/planted_link.h"

namespace lamina {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw FileError(
      fmt::format("Can't write '{}': {}", path, std::strerror(error)));
}

}  // namespace

AppendFile AppendFile::open(const std::string& path, const FileAccess& access) {
  const OutputPlace place = access.find_output(path);
  if (place.error != 0) fail(path, place.error);
  OpenFile file(::open(place.path.c_str(),
                       O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW,
                       0666));
  struct stat status {};
  if (!file || ::fstat(file.descriptor(), &status) != 0) fail(path, errno);
  if (!S_ISREG(status.st_mode)) {
    throw FileError(
        fmt::format("Can't write '{}': it is no regular file", path));
  }
  if (is_planted_at(place.path, status)) fail(path, EACCES);
  if (access.run_files() != nullptr) {
    access.run_files()->expect_files(path, status, access);
  }
  bool is_torn = false;
  if (status.st_size > 0) {
    const auto last =
        file.read_at(static_cast<std::uint64_t>(status.st_size - 1), 1);
    if (!last) fail(path, errno);
    is_torn = *last != "\n";
  }
  return {path, std::move(file), is_torn};
}

void AppendFile::append(std::string_view line) {
  std::string bytes = is_torn_ ? "\n" : "";
  bytes += line;
  bytes += '\n';
  ssize_t count = -1;
  do {
    count = ::write(file_.descriptor(), bytes.data(), bytes.size());
  } while (count < 0 && errno == EINTR);
  if (count == static_cast<ssize_t>(bytes.size())) {
    is_torn_ = false;
    return;
  }
  if (count > 0) is_torn_ = true;
  fail(path_, count < 0 ? errno : ENOSPC);
}

void AppendFile::sync() {
  if (::fdatasync(file_.descriptor()) != 0) fail(path_, errno);
}

}  // namespace lamina
