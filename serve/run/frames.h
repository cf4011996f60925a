#pragma once
// What a run sends to the server through a pipe: frames of a kind and
// some bytes.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::serve {

enum class FrameKind : char {
  kEvent = 'e',   // JSON for the page, as docs/studio.md has it
  kLast = 'l',    // the last event of a choice, likewise
  kFiles = 'f',   // the files that the design depends on, each with a '\n'
  kAnswer = 'a',  // of an output or a source: a status and JSON, "200 {…}"
};

// Writes a frame. False where nobody reads any more.
bool write_frame(int descriptor, FrameKind kind, std::string_view bytes);

// Writes a frame, from a run. Ends its process where nobody reads any more:
// what it makes has been given up.
void send_frame(int descriptor, FrameKind kind, std::string_view bytes);

// A frame of kAnswer.
struct RunAnswer {
  unsigned status = 500;
  std::string json;
};
void send_answer(int descriptor, const RunAnswer& answer);
RunAnswer read_answer(std::string_view frame);

// A frame of kFiles.
void send_files(int descriptor, const std::vector<std::string>& files);
// The absolute paths in it.
std::set<std::string> read_files(std::string_view frame);

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
