// lamina studio: a page that shows a design's layers while its parameters
// change.

#include "serve/studio/studio.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file/module.h"
#include "base/file/open_file.h"
#include "base/paths.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/session.h"
#include "compiler/validate.h"
#include "serve/http/server.h"
#include "serve/run/names.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStudioHelp =
    R"(Usage: lamina studio DESIGN [OPTION]...
       lamina studio FOLDER [OPTION]...

Shows a design, or one of a folder's, in a browser: its parameters as a form, and
its layers, its solid, its weight and what 'lamina check' finds while they
change. Follows the files when an editor saves them. Takes any option of Design,
Slicing and Limits (see 'lamina --help'). Only this machine can open the page.
Ctrl-C ends it.

  --port N          the port of 127.0.0.1 to serve it on [8270, or any free one]
  --open            open it in the browser, too
  --printer P, --material M, --metal M, --price PRICES
                    what it is made with, as for slicing; the page can change it
  --min-feature MM  mark walls and gaps thinner than this
  --self-supporting MM
                    how far a layer may stand out over the one below

  -q, --quiet       say nothing but the address and errors
  -h, --help        print this help
)";

constexpr std::uint16_t kUsualPort = 8270;
constexpr double kMostSeconds = 600;  // of processor time, for one change

// The secret of the studio before on this port, so that its pages go on with
// this one; a new one where there was none. Empty where the system has no
// folder for what lives as long as a login.
std::string kept_secret(std::uint16_t port) {
  const char* const folder = std::getenv("XDG_RUNTIME_DIR");
  if (folder == nullptr || *folder != '/') return {};
  const std::string path = fmt::format("{}/lamina-studio-{}", folder, port);
  const OpenFile known(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  struct stat status {};
  if (known && ::fstat(known.descriptor(), &status) == 0 &&
      S_ISREG(status.st_mode) && status.st_uid == ::getuid() &&
      (status.st_mode & 077) == 0) {
    const auto secret = known.read_all();
    if (secret && secret->size() == studio::random_digits().size()) {
      return *secret;
    }
  }
  const OpenFile kept(
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW,
             0600));
  if (!kept) return {};
  std::string secret = studio::random_digits();
  return write_all(kept.descriptor(), secret) == 0 ? secret : "";
}

// The designs of a folder, in alphabetical order.
std::vector<std::string> designs_in(const std::string& folder,
                                    const FileAccess& access) {
  std::vector<std::string> designs;
  for (const std::string& name :
       access.list(folder).value_or(std::vector<std::string>())) {
    if (compiler::is_design(name)) designs.push_back(name);
  }
  std::ranges::sort(designs);
  if (designs.empty()) {
    throw FileError(fmt::format("there is no .scad and no .csg in '{}'",
                                shown_path(folder)));
  }
  return designs;
}

void open_in_browser(const std::string& address) {
  std::string program = "xdg-open";
  std::string argument = address;
  char* words[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  if (::posix_spawnp(&process, "xdg-open", nullptr, nullptr, words, environ) !=
      0) {
    throw FileError("--open needs the program xdg-open (Debian: xdg-utils)");
  }
}

class StudioCommand : public Command {
 public:
  std::string_view help() const override { return kStudioHelp; }

  void add_options(OptionList& options) override {
    options.word("file", request_.design.path).required();
    options.whole("--port", port_, 1, 65535);
    options.flag("--open", opens_);
    add_print_options(options, request_);
    add_machine_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
  }

  bool takes_settings() const override { return true; }

  void check() override {
    refuse_if(request_.design.path == "-",
              "studio needs the name of a design or a folder");
    refuse_if(!request_.job.heights.empty(),
              "studio needs whole layers, not --heights");
    refuse_if(!request_.design.parameter_file.empty(),
              "the page of the studio loads parameter sets, not -p");
    request_.job.finds_makers = true;
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    return run_caught(terminal, {}, [&] {
      refuse_if(context.file_access().is_confined(),
                "studio serves the user who runs it, and takes no --root");
      return serve(context, terminal);
    });
  }

 private:
  studio::StudioOptions options_for(const Context& context) const {
    const FileAccess& access = context.file_access();
    const std::string& path = request_.design.path;
    studio::StudioOptions options;
    options.request = serve::with_known_names(request_, access);
    options.evaluation_stack = context.stack / 2;
    options.most_seconds = static_cast<unsigned>(
        std::clamp(context.watch.limits().seconds, 1.0, kMostSeconds));
    const auto there = access.look_at(path);
    if (there && S_ISDIR(there->st_mode)) {
      options.folder = path.ends_with('/') ? path : path + '/';
      options.designs = designs_in(path, access);
      return options;
    }
    if (!access.is_file(path)) {
      throw FileError(fmt::format("Can't open input file '{}'!", path));
    }
    const std::string name = fs::path(path).filename();
    options.folder = path.substr(0, path.size() - name.size());
    options.designs = {name};
    return options;
  }

  // Listens on the port that was asked for, or on the usual one, if it is free.
  OpenFile open_listener() const {
    const std::string port = std::to_string(port_.value_or(kUsualPort));
    try {
      return http::open_listener(http::parse_address(port));
    } catch (const FileError&) {
      if (port_) throw;
    }
    return http::open_listener(http::parse_address("0"));
  }

  int serve(const Context& context, Terminal& terminal) {
    context.watch.time_parts();
    studio::StudioOptions options = options_for(context);
    Diagnostics diagnostics(
        [&](const Diagnostic& message) { terminal.show(message); });
    std::vector<std::string> folders = module_folders();
    const auto server = http::make_server({}, {}, folders, diagnostics);
    OpenFile listener = open_listener();
    const std::uint16_t port = http::address_of(listener).port;
    server->listen(std::move(listener));
    options.secret = kept_secret(port);
    studio::Studio studio(std::move(options), *server, context.temporary_files,
                          [&](const std::string& line) { terminal.say(line); });
    const std::string address = studio.address(port);
    print_out(address + "\n");
    terminal.say("open this address in a browser of this machine; Ctrl-C ends");
    if (opens_) open_in_browser(address);
    server->run([&](const http::Request& request,
                    const std::shared_ptr<http::Reply>& reply) {
      studio.answer(request, reply);
    });
    return kDone;
  }

  compiler::Request request_;
  bool is_quiet_ = false;
  bool opens_ = false;
  std::optional<unsigned> port_;
};

}  // namespace

std::unique_ptr<Command> make_studio_command() {
  return std::make_unique<StudioCommand>();
}

}  // namespace lamina::cli
