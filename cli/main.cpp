// The program lamina: finds the command, reads its words, and runs it. Only
// cli/ prints messages, shows faults and chooses exit statuses.

#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include "base/letter_case.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/common_options.h"
#include "cli/options/user_settings.h"
#include "cli/process/exit_status.h"
#include "cli/process/landlock.h"
#include "cli/process/process_watch.h"
#include "cli/process/run_on_stack.h"
#include "cli/process/streams.h"
#include "cli/report/session.h"

namespace lamina::cli {
namespace {

int show_fault(std::string_view message, int status = kUsageFault) {
  print_error(fmt::format(
      "lamina: {}\n", message_text(with_display_paths(std::string(message)))));
  if (status == kUsageFault) {
    print_error("Run 'lamina --help' for the options.\n");
  }
  return status;
}

// Reads the words into the options of `command`, `limits` and `access`. Returns
// the exit status where there is nothing to run: help or the version was asked
// for, or the usage was wrong.
std::optional<int> read_words(Command& command, ProcessLimits& limits,
                              FileAccess& access, int argc,
                              const char* const* argv) {
  OptionList options;
  command.add_options(options);
  FileAccess::Limits access_limits;
  add_common_options(options, limits, access_limits);
  try {
    if (const auto answer =
            options.read(argc, argv, command.short_help(), command.help())) {
      print_out(*answer);
      return kDone;
    }
    access = make_file_access(access_limits);
    if (access.is_confined()) {
      name_files_from(access_limits.root, access.canonical(access_limits.root));
    } else if (command.takes_settings()) {
      apply_user_settings(
          read_user_settings(settings_files(first_file(options)), access),
          options);
    }
    command.check();
    access.report_to(std::make_shared<RunFiles>());
  } catch (const RequestError& error) {
    return show_fault(error.what());
  }
  return std::nullopt;
}

// Catches what global objects of libraries throw before main() begins.
[[gnu::constructor(101)]] void expect_the_worst() {
  std::set_terminate([] {
    print_error("lamina: out of memory\n");
    ::_exit(kFault);
  });
}

// From the first moment on a signal ends the program as an interrupt does later
// (cli/process/run_on_stack.h); until then it has made nothing that would have
// to be removed. Runs before libraries begin, which takes a millisecond.
void expect_signals(int /*argc*/, char** /*argv*/, char** /*environment*/) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_DFL) continue;  // nohup
    action.sa_handler = [](int) { ::_exit(kInterrupted); };
    ::sigaction(signal, &action, nullptr);
  }
}
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const kFirstOfAll)(int, char**, char**) = expect_signals;

// As openscad's, an output x.png is a picture: of the layers as a solid, which
// view draws. A folder of images is asked for by its '/', or by a panel.
bool asks_for_picture(std::span<const char* const> words) {
  bool is_picture = false;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word.starts_with("--printer") || word.starts_with("--export-format")) {
      return false;
    }
    if (!word.starts_with("-o")) continue;
    const std::string_view output = word.size() > 2        ? word.substr(2)
                                    : i + 1 < words.size() ? words[i + 1]
                                                           : "";
    is_picture = lower_case(output).ends_with(".png") &&
                 output.find('{') == std::string_view::npos;
  }
  return is_picture;
}

// Returns the exit status.
int run_program(int argc, char** argv) {
  std::vector<const char*> words(argv, argv + argc);
  // As other programs have them: help, help COMMAND, version, slice.
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first == "version") words = {argv[0], "--version"};
  if (first == "help" || first == "slice") words.erase(words.begin() + 1);
  if (first == "help") words.push_back("--help");
  std::unique_ptr<Command> command;
  for (const NamedCommand& named : kNamedCommands) {
    if (words.size() > 1 && words[1] == named.name) command = named.make();
  }
  // A named command's own words begin behind its name.
  const std::size_t skipped = command ? 1 : 0;
  if (!command && asks_for_picture(words)) {
    command = make_view_command();
    words.insert(words.end(), {"--style", "stack"});
  }
  if (!command) command = make_slice_command();
  ProcessLimits limits;
  FileAccess access;
  if (const auto status = read_words(*command, limits, access,
                                     static_cast<int>(words.size() - skipped),
                                     words.data() + skipped)) {
    return *status;
  }
  restrict_process(access);
  TemporaryFiles temporary_files(access);
  ProcessWatch watch(limits);
  Interrupt interrupt;
  return run_on_stack(
      temporary_files, watch, interrupt, [&](std::size_t stack) {
        // A session may fail to begin.
        Terminal terminal(false);
        return run_caught(terminal, {}, [&] {
          return command->run({temporary_files, stack, watch, interrupt});
        });
      });
}

}  // namespace
}  // namespace lamina::cli

int main(int argc, char** argv) {
  using namespace lamina;
  cli::open_missing_streams();
  // The commands, on the large stack, catch and show their own faults.
  try {
    return cli::run_program(argc, argv);
  } catch (const cli::ReaderGone&) {
    return cli::kFault;
  } catch (const std::bad_alloc&) {
    cli::print_error("lamina: out of memory\n");
  } catch (const std::exception& error) {
    return cli::show_fault(error.what(), cli::kFault);
  }
  return cli::kFault;
}
