#pragma once
// What a run sends to the server through a pipe: frames of a kind and
// some bytes.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace lamina::serve {

enum class FrameKind : char {
  kEvent = 'e',   // JSON for the page, as docs/studio.md has it
  kLast = 'l',    // the last event of a choice, likewise
  kFiles = 'f',   // the files that the design depends on, each with a '\n'
  kAnswer = 'a',  // of an output or a source: a status and JSON, "200 {…}"
};

// Writes a frame. False where nobody reads any more.
bool write_frame(int descriptor, FrameKind kind, std::string_view bytes);

// Takes the bytes of a pipe as they come.
class FrameReader {
 public:
  // Calls `take` for each frame that is complete now.
  void add(std::string_view bytes,
           const std::function<void(FrameKind, std::string)>& take);

 private:
  std::string bytes_;
};

}  // namespace lamina::serve
