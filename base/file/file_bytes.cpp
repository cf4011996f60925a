#include "base/file/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <new>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diagnostic.h"

namespace lamina {
namespace {

[[noreturn]] void fail(const std::string& path, const char* why) {
  throw FileError(fmt::format("Can't read '{}': {}", path, why));
}

// Memory of whole pages, large ones where the system has them.
void* map_memory(std::size_t size) {
  if (size == 0) return nullptr;
  void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  ::madvise(memory, size, MADV_HUGEPAGE);  // a wish
  return memory;
}

// Fills the memory; false if the file ends before (errno 0) or fails.
bool read_all(int file, char* memory, std::size_t size) {
  while (size > 0) {
    errno = 0;
    const ssize_t count = ::read(file, memory, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    memory += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

std::optional<FileBytes> FileBytes::open(const std::string& path,
                                         const FileAccess& access) {
  const OpenFile file = access.open(path);
  if (!file) return std::nullopt;
  struct stat status = {};
  if (::fstat(file.descriptor(), &status) != 0) {
    fail(path, std::strerror(errno));
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  FileBytes bytes(map_memory(size), size);
  const bool is_whole =
      read_all(file.descriptor(), static_cast<char*>(bytes.data_), size);
  if (!is_whole && errno != 0) fail(path, std::strerror(errno));
  if (!is_whole || !file.is_unchanged_since(status)) {
    fail(path, "it changed while it was read");
  }
  return bytes;
}

FileBytes::~FileBytes() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

}  // namespace lamina
