#include "serve/run/frames.h"

#include <array>
#include <cstring>

#include "base/file/open_file.h"

namespace lamina::serve {
namespace {

// A kind, and the number of bytes.
constexpr std::size_t kHeadSize = 1 + sizeof(std::uint32_t);

}  // namespace

bool write_frame(int descriptor, FrameKind kind, std::string_view bytes) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::string frame(kHeadSize, static_cast<char>(kind));
  std::memcpy(frame.data() + 1, &size, sizeof size);
  frame += bytes;
  return write_all(descriptor, frame) == 0;
}

void FrameReader::add(std::string_view bytes,
                      const std::function<void(FrameKind, std::string)>& take) {
  bytes_ += bytes;
  std::size_t begin = 0;
  while (bytes_.size() - begin >= kHeadSize) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes_.data() + begin + 1, sizeof size);
    if (bytes_.size() - begin - kHeadSize < size) break;
    take(static_cast<FrameKind>(bytes_[begin]),
         bytes_.substr(begin + kHeadSize, size));
    begin += kHeadSize + size;
  }
  bytes_.erase(0, begin);
}

}  // namespace lamina::serve
