// The program lamina: finds the command, has its words read, and runs it.
// Messages are printed, faults shown and exit statuses chosen in cli/ alone.

#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "base/memory_end.h"
#include "cli/commands/command.h"
#include "cli/commands/commands.h"
#include "cli/options/common_options.h"
#include "cli/process/exit_status.h"
#include "cli/process/landlock.h"
#include "cli/process/process_watch.h"
#include "cli/process/run_on_stack.h"
#include "cli/process/streams.h"

namespace lamina::cli {
namespace {

// Nothing to run: help and version were asked for, or the usage was wrong.
struct Exit {
  int status = kDone;
  std::string text;  // to standard output (status 0) or standard error
};

Exit usage_fault(std::string_view message) {
  return {kUsageFault, fmt::format("lamina: {}\nRun 'lamina --help' for "
                                   "the options.\n",
                                   message)};
}

// Reads the words into the options of `command`, `limits` and `access`; a value
// where that was all.
std::optional<Exit> read_words(Command& command, ProcessLimits& limits,
                               FileAccess& access, int argc,
                               const char* const* argv) {
  CLI::App app("", "lamina");
  command.add_options(app);
  FileAccess::Limits access_limits;
  add_common_options(app, limits, access_limits);
  try {
    app.parse(argc, argv);
    command.check();
    access = make_file_access(access_limits);
  } catch (const CLI::CallForHelp&) {
    return Exit{kDone, std::string(command.help())};
  } catch (const CLI::CallForVersion& version) {
    return Exit{kDone, fmt::format("{}\n", version.what())};
  } catch (const CLI::ParseError& error) {
    return usage_fault(error.what());
  } catch (const UsageError& error) {
    if (error.status() == kUsageFault) return usage_fault(error.what());
    return Exit{error.status(), fmt::format("lamina: {}\n", error.what())};
  }
  return std::nullopt;
}

// What is thrown before main() begins, by global objects of libraries.
[[gnu::constructor(101)]] void expect_the_worst() {
  std::set_terminate([] {
    print_error("lamina: out of memory\n");
    ::_exit(kFault);
  });
}

// The exit status.
int run_program(int argc, char** argv) {
  std::unique_ptr<Command> command;
  for (const NamedCommand& named : kNamedCommands) {
    if (argc > 1 && argv[1] == named.name) command = named.make();
  }
  // A named command's own words begin behind its name.
  const int skipped = command ? 1 : 0;
  if (!command) command = make_slice_command();
  ProcessLimits limits;
  FileAccess access;
  if (const auto exit = read_words(*command, limits, access, argc - skipped,
                                   argv + skipped)) {
    if (exit->status == kDone) {
      print_out(exit->text);
    } else {
      print_error(exit->text);
    }
    return exit->status;
  }
  restrict_process(access);
  TemporaryFiles temporary_files(access);
  ProcessWatch watch(limits);
  return run_on_stack(temporary_files, watch, [&](std::size_t stack) {
    return command->run({temporary_files, stack, watch});
  });
}

}  // namespace
}  // namespace lamina::cli

int main(int argc, char** argv) {
  using namespace lamina;
  std::set_new_handler(note_memory_end);
  cli::open_missing_streams();
  // What runs on the large stack is caught there, with all that it has to say.
  try {
    return cli::run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    cli::print_error("lamina: out of memory\n");
  } catch (const std::exception& error) {
    cli::print_error("lamina: ");
    cli::print_error(error.what());
    cli::print_error("\n");
  }
  return cli::kFault;
}
