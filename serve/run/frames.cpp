#include "serve/run/frames.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>

#include "base/file/open_file.h"
#include "base/paths.h"
#include "base/text.h"

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

void send_frame(int descriptor, FrameKind kind, std::string_view bytes) {
  if (!write_frame(descriptor, kind, bytes)) ::_exit(0);
}

void send_answer(int descriptor, const RunAnswer& answer) {
  send_frame(descriptor, FrameKind::kAnswer,
             fmt::format("{} {}", answer.status, answer.json));
}

RunAnswer read_answer(std::string_view frame) {
  const std::size_t blank = std::min(frame.find(' '), frame.size());
  const auto status = parse_number(frame.substr(0, blank)).value_or(500);
  frame.remove_prefix(std::min(blank + 1, frame.size()));
  return {static_cast<unsigned>(status), std::string(frame)};
}

void send_files(int descriptor, const std::vector<std::string>& files) {
  std::string list;
  for (const std::string& file : files) list += file + '\n';
  send_frame(descriptor, FrameKind::kFiles, list);
}

std::set<std::string> read_files(std::string_view frame) {
  std::set<std::string> files;
  while (!frame.empty()) {
    const std::size_t end = std::min(frame.find('\n'), frame.size());
    if (end > 0) files.insert(absolute_path(std::string(frame.substr(0, end))));
    frame.remove_prefix(std::min(end + 1, frame.size()));
  }
  return files;
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
