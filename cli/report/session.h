#pragma once
// What a user sees of a compilation on standard error: messages as they come
// up, progress, a closing line.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "cli/process/context.h"
#include "cli/process/progress.h"
#include "compiler/compilation.h"
#include "slicer/contour/layer_file.h"

namespace lamina::cli {

// Takes the messages of one compilation among several, instead of standard
// error: they are shown together when it has ended.
struct Inbox {
  // Of every message: "orders.csv:17: "; its further lines are indented.
  std::string prefix;
  bool has_progress = false;  // it is alone and may draw its progress
  std::string text;
  std::string first_error;  // its words alone
};

class Terminal {
 public:
  // is_quiet  shows nothing but errors
  // inbox     null: standard error; else it outlives the terminal
  explicit Terminal(bool is_quiet, Inbox* inbox = nullptr);
  ~Terminal();  // finishes
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // Shows a message in caret form. One that was shown before is only counted;
  // equal echoes are counted while they follow each other. When quiet, errors
  // only, and what ends the run.
  void show(const Diagnostic& diagnostic, bool ends_run = false);

  // A line of its own; not when quiet.
  void say(std::string_view line);

  bool is_quiet() const { return is_quiet_; }

  // The line that shows how far the work is; messages are written above it.
  ProgressLine& progress() { return progress_; }

  // Writes how often messages were repeated.
  void finish();

 private:
  void write(std::string_view text);
  void end_echoes();

  bool is_quiet_;
  Inbox* inbox_;
  ProgressLine progress_;
  std::string last_echo_;
  std::uint64_t echo_count_ = 0;
  std::map<std::string, std::uint64_t> counts_;  // caret text → times
};

// A compilation whose messages and progress the user sees.
struct Session {
  // request  outlives the session
  // inbox    as of Terminal
  Session(const compiler::Request& request, bool is_quiet,
          const Context& context, Inbox* inbox = nullptr);

  // run_caught() with the session's own terminal and messages.
  int run(const std::function<int()>& work);

  Terminal terminal;
  compiler::Compilation compilation;
};

// Says what a layer file holds that was not taken, if anything.
void report_skipped(compiler::Compilation& compilation,
                    const slicer::LayerFileFacts& facts);

// Returns what `work` returns; where it throws, shows the message, unless it
// is among the messages that have been shown, and returns kFault, or
// kUsageFault for a RequestError. `work` may add to these messages.
int run_caught(Terminal& terminal, const std::vector<const Diagnostics*>& shown,
               const std::function<int()>& work);

}  // namespace lamina::cli
