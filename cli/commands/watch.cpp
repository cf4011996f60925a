#include "cli/commands/watch.h"

#include <ctime>
#include <filesystem>
#include <set>
#include <string>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/diagnostic.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/process/exit_status.h"
#include "cli/report/run_report.h"
#include "serve/run/file_watcher.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

// The files that are known before the compilation.
std::set<std::string> given_files(const compiler::Request& request) {
  std::set<std::string> files = {request.design.path};
  if (!request.design.parameter_file.empty())
    files.insert(request.design.parameter_file);
  for (const std::string& profile :
       {request.output.printer, request.output.material,
        request.output.metal}) {
    if (fs::is_regular_file(profile)) files.insert(profile);
  }
  return files;
}

std::string change_line(const std::set<std::string>& files) {
  std::set<std::string> names;
  for (const std::string& file : files) {
    names.insert(on_one_line(shown_path(file)));
  }
  return fmt::format("{:%H:%M:%S} {} changed",
                     fmt::localtime(std::time(nullptr)),
                     fmt::join(names, ", "));
}

// Adds the files on which the output was found to depend. Returns whether the
// compilation ended well.
bool compile_once(const compiler::Request& request, const Closing& closing,
                  bool is_quiet, const Context& context,
                  std::set<std::string>& files) {
  const ProcessWatch::Part timed(context.watch, "");
  const double earlier_seconds = process_seconds();
  context.file_access().run_files()->begin_again(context.file_access());
  Session session(request, is_quiet, context);
  const int status = session.run(
      [&] { return compile_and_report(session, closing, earlier_seconds); });
  const compiler::Compilation& compilation = session.compilation;
  for (const auto* list :
       {&compilation.loader.files(), &compilation.loader.missing(),
        &compilation.tree.files}) {
    files.insert(list->begin(), list->end());
  }
  return status == kDone;
}

}  // namespace

void compile_and_watch(const compiler::Request& request, const Closing& closing,
                       bool is_quiet, const Context& context) {
  context.watch.time_parts();
  serve::FileWatcher watcher;
  Terminal terminal(is_quiet);
  std::set<std::string> watched = given_files(request);
  watcher.watch(watched, fs::file_time_type::max());
  while (true) {
    const auto begin = serve::FileWatcher::now();
    std::set<std::string> files = given_files(request);
    const bool is_done =
        compile_once(request, closing, is_quiet, context, files);
    // A design that failed half way does not know all that it depends on.
    if (!is_done) files.insert(watched.begin(), watched.end());
    watched = files;
    watcher.watch(watched, begin);
    terminal.say(fmt::format("watching {}; Ctrl-C ends",
                             counted(watched.size(), "file")));
    terminal.say(change_line(watcher.wait()));
  }
}

}  // namespace lamina::cli
