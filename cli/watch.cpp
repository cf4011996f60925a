#include "cli/watch.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <set>
#include <string>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.h"
#include "cli/process/file_watcher.h"
#include "cli/report/terminal.h"
#include "compiler/compile.h"
#include "compiler/run.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

// The times of files come from a clock that ticks this seldom, at most.
constexpr std::chrono::milliseconds kClockStep{10};

// Those that are known before the run.
std::set<std::string> given_files(const DesignOptions& options) {
  std::set<std::string> files = {options.design};
  if (!options.parameter_file.empty()) files.insert(options.parameter_file);
  if (fs::is_regular_file(options.printer)) files.insert(options.printer);
  return files;
}

// As short as it can be said from the folder in which the program runs.
std::string shown(const std::string& file) {
  std::error_code error;
  const std::string path = fs::proximate(file, error).string();
  return error || path.starts_with("..") ? file : path;
}

std::string change_line(const std::set<std::string>& files) {
  std::set<std::string> names;
  for (const std::string& file : files) names.insert(shown(file));
  return fmt::format("{:%H:%M:%S} {} changed",
                     fmt::localtime(std::time(nullptr)),
                     fmt::join(names, ", "));
}

// Adds what the run found to depend on; true if it ended well.
bool compile_once(const DesignOptions& options, TemporaryFiles& temporary_files,
                  std::size_t stack, ProcessWatch& watch,
                  std::set<std::string>& files) {
  const ProcessWatch::Piece timed(watch, "");
  const double earlier_seconds = process_seconds();
  Run run(options, temporary_files, stack);
  run.report.earlier_seconds = earlier_seconds;
  const int status = run_caught(run.terminal, run.diagnostics, [&] {
    const int compiled = compile(run);
    if (compiled == kDone) show_report(run);
    return compiled;
  });
  files.insert(run.loader.files().begin(), run.loader.files().end());
  files.insert(run.named_files.begin(), run.named_files.end());
  return status == kDone;
}

}  // namespace

void compile_and_watch(const DesignOptions& options,
                       TemporaryFiles& temporary_files, std::size_t stack,
                       ProcessWatch& watch) {
  watch.time_pieces();
  FileWatcher watcher;
  Terminal terminal(options.is_quiet);
  std::set<std::string> watched = given_files(options);
  watcher.watch(watched, fs::file_time_type::max());
  while (true) {
    const auto begin = fs::file_time_type::clock::now() - kClockStep;
    std::set<std::string> files = given_files(options);
    const bool is_done =
        compile_once(options, temporary_files, stack, watch, files);
    // A design that failed half way does not know all that it depends on.
    if (!is_done) files.insert(watched.begin(), watched.end());
    watched = files;
    watcher.watch(watched, begin);
    terminal.say(fmt::format("watching {} files; Ctrl-C ends", watched.size()));
    terminal.say(change_line(watcher.wait()));
  }
}

}  // namespace lamina::cli
