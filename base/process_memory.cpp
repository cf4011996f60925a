#include "base/process_memory.h"

#include <algorithm>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

namespace lamina {
namespace {

// The given field of /proc/self/statm, which counts pages. Takes no memory.
std::uint64_t bytes_in_field(int field) {
  char text[256];
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t size = ::read(file, text, sizeof text - 1);
  ::close(file);
  text[std::max<ssize_t>(size, 0)] = '\0';
  char* next = text;
  std::uint64_t pages = 0;
  for (int i = 0; i <= field; ++i) pages = std::strtoull(next, &next, 10);
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

std::uint64_t resident_memory() { return bytes_in_field(1); }

std::uint64_t writable_memory() { return bytes_in_field(5); }

}  // namespace lamina
