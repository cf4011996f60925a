#pragma once
// What a user sees on standard error: messages as they come up, progress, a
// closing line.

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "parser/diagnostic.h"
#include "slicer/layer.h"

namespace lamina::cli {

class Terminal {
 public:
  // is_quiet  shows nothing but errors
  explicit Terminal(bool is_quiet);
  ~Terminal();  // finishes
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // Shows a message in caret form. One that was shown before is only counted;
  // equal echoes are counted while they follow each other.
  void show(const Diagnostic& diagnostic);

  // A line of its own; not when quiet.
  void say(std::string_view line);

  // How far the slicing is, 0 … 1; shown on a terminal only, a few times a
  // second.
  void show_progress(double share);

  // Tells how often messages were repeated.
  void finish();

 private:
  void write(std::string_view text);
  void end_echoes();
  void clear_progress();

  bool is_quiet_;
  bool is_terminal_;
  bool has_progress_ = false;
  std::chrono::steady_clock::time_point last_progress_;
  std::string last_echo_;
  std::uint64_t echo_count_ = 0;
  std::map<std::string, std::uint64_t> counts_;  // caret text → times
};

// Passes layers on and shows how far they have come between two heights.
class ProgressSink : public slicer::LayerSink {
 public:
  ProgressSink(slicer::LayerSink& sink, Terminal& terminal)
      : sink_(sink), terminal_(terminal) {}

  void begin(const Box3& box) override;
  void take(const slicer::Layer& layer) override;

 private:
  slicer::LayerSink& sink_;
  Terminal& terminal_;
  double bottom_ = 0;
  double top_ = 0;
};

}  // namespace lamina::cli
