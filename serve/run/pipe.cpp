#include "serve/run/pipe.h"

#include <cerrno>
#include <cstddef>

#include <unistd.h>

namespace lamina::serve {

std::optional<std::string> read_some(int pipe) {
  std::string bytes(1 << 16, '\0');
  const ssize_t size = ::read(pipe, bytes.data(), bytes.size());
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

}  // namespace lamina::serve
