#include "cli/process/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/process/streams.h"

namespace lamina::cli {
namespace {

// Shorter runs are over before anybody looks.
constexpr std::chrono::milliseconds kDelay{500};
constexpr std::chrono::milliseconds kPeriod{100};

// How much must be done before the rest can be guessed.
constexpr double kKnownShare = 0.03;

constexpr std::size_t kUsualWidth = 80;
constexpr std::size_t kNarrowestBar = 10;
constexpr std::size_t kWidestBar = 30;

// Guards the one terminal that the program has.
std::mutex drawing;

bool is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

std::size_t terminal_width() {
  winsize size{};
  const bool is_known =
      ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : kUsualWidth;
}

// "4 s", "2 min 05 s", "1 h 12 min"
std::string duration_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

// "812", "5.3"
std::string rate_text(double rate) {
  return rate < 10 ? fmt::format("{:.1f}", rate) : fmt::format("{:.0f}", rate);
}

std::string bar(double share, std::size_t width) {
  const std::size_t inside = width - 2;
  const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) *
                                               static_cast<double>(inside));
  std::string text(inside, ' ');
  std::fill_n(text.begin(), filled, '=');
  if (filled < inside) text[filled] = '>';
  return fmt::format("[{}]", text);
}

}  // namespace

std::string progress_text(const Progress& progress, std::size_t width) {
  const std::string total = fmt::format("{}", progress.total);
  std::string text = fmt::format("{:>{}} of {} {}", progress.done, total.size(),
                                 total, progress.unit);
  const auto done = static_cast<double>(progress.done);
  const auto all = static_cast<double>(progress.total);
  if (done >= kKnownShare * all && progress.seconds > 0) {
    const double rate = done / progress.seconds;
    text += fmt::format(", {}/s, {} left", rate_text(rate),
                        duration_text(std::max(0.0, all - done) / rate));
  }
  // A blank between bar and text.
  if (text.size() + 1 + kNarrowestBar <= width && progress.total > 0) {
    const std::size_t room = width - text.size() - 1;
    return fmt::format("{} {}", bar(done / all, std::min(room, kWidestBar)),
                       text);
  }
  return text.substr(0, width);
}

ProgressLine::ProgressLine(bool is_wanted)
    : is_wanted_(is_wanted && is_terminal()) {}

void ProgressLine::begin(std::uint64_t total, std::string_view unit) {
  if (!is_wanted_) return;
  erase();
  progress_.total = total;
  progress_.unit = unit;
  begin_ = Clock::now();
  next_ = begin_ + kDelay;
}

void ProgressLine::say(std::string_view words) {
  if (is_wanted_) draw(fmt::format("{} ...", words));
}

void ProgressLine::show(std::uint64_t done) {
  if (!is_wanted_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kPeriod;
  progress_.done = done;
  progress_.seconds = std::chrono::duration<double>(now - begin_).count();
  // In the last column the cursor would go on to the next line.
  draw(progress_text(progress_, terminal_width() - 1));
}

void ProgressLine::draw(const std::string& text) {
  const std::string line = fmt::format("\r{:<{}}", text, drawn_);
  const std::lock_guard lock(drawing);
  std::fwrite(line.data(), 1, line.size(), stderr);
  drawn_ = text.size();
}

void ProgressLine::erase() {
  if (drawn_ == 0) return;
  const std::string line = fmt::format("\r{:<{}}\r", "", drawn_);
  std::fwrite(line.data(), 1, line.size(), stderr);
  drawn_ = 0;
}

void end_progress() {
  if (!is_terminal()) return;
  // The lock is never given back.
  drawing.lock();
  // Not by stdio, whose lock a thread may hold that the terminal keeps waiting.
  print_error(fmt::format("\r{:<{}}\r", "", terminal_width() - 1));
}

}  // namespace lamina::cli
