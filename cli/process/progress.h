#pragma once
// Shows how far a long run is, by one line at the bottom of a terminal, which
// is drawn over and over, and removed at the end.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace lamina::cli {

struct Progress {
  std::uint64_t done = 0;
  std::uint64_t total = 0;
  std::string_view unit;  // what is counted: "layers"
  double seconds = 0;     // since the first of them was begun
};

// "[=====>     ]  1240 of 4000 layers, 812/s, 4 s left"
//
// width  columns that may be used; where they are few, the bar is left out
std::string progress_text(const Progress& progress, std::size_t width);

// Draws on standard error, if that is a terminal. A call costs a look at the
// clock.
class ProgressLine {
 public:
  // is_wanted  false: nothing is ever drawn
  explicit ProgressLine(bool is_wanted);
  ~ProgressLine() { erase(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Says what is done before there is something to count.
  void say(std::string_view words);

  // Begins to count the time, and says what is counted.
  void begin(std::uint64_t total, std::string_view unit);

  // Draws the line, unless that was done a moment ago or the work has just
  // begun.
  void show(std::uint64_t done);

  // Removes the line. To be called before anything else is written to the
  // terminal, and at the end.
  void erase();

 private:
  void draw(const std::string& text);

  using Clock = std::chrono::steady_clock;

  bool is_wanted_;
  Progress progress_;
  Clock::time_point begin_;
  Clock::time_point next_;
  std::size_t drawn_ = 0;  // columns
};

// Removes the line and forbids new ones from now on: for the thread that ends
// the process after an interrupt. Waits as long as the terminal is stopped.
void end_progress();

}  // namespace lamina::cli
