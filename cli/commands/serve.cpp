// lamina serve: answers orders of a folder's designs for other programs.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "base/file/module.h"
#include "base/file/open_file.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/machine_memory.h"
#include "cli/process/streams.h"
#include "cli/report/session.h"
#include "compiler/validate.h"
#include "serve/http/listener.h"
#include "serve/http/server.h"
#include "serve/run/names.h"
#include "serve/shop/shop.h"

namespace lamina::cli {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view kServeHelp =
    R"(Usage: lamina serve --root FOLDER [OPTION]...

Answers other programs that ask, over HTTP, what a piece of a design in FOLDER
weighs and costs with the values that a customer has chosen, and that order its
layers, a picture or a page. Takes any option of Design, Slicing and Limits (see
'lamina --help'); an order can change some. Ctrl-C and SIGTERM end it when all
orders are answered. docs/serve.md has the requests; the service describes them
at /openapi.json.

  --root FOLDER     the designs; they read nothing outside of it
  --listen ADDRESS  a port of 127.0.0.1, an address with a port (0.0.0.0:80,
                    [::1]:80), or the path of a Unix socket [8280]
  --host NAME       a Host that requests may have; may be repeated [this machine
                    where only this machine can ask, else any]
  --workers N       orders that run at once [as many as there are processors]
  --queue N         orders that wait; further ones are refused [64]
  --printer P, --material M, --metal M, --price PRICES
                    what pieces are made with, unless an order says
  --min-feature MM  list walls and gaps thinner than this
  --no-strict       make pieces with warnings, too
  --max-time S      processor time of one order [10]
  --max-memory SIZE memory of all orders together [80%]

  -q, --quiet       say nothing but errors
  -h, --help        print this help
)";

constexpr const char* kUsualAddress = "8280";
constexpr unsigned kUsualSeconds = 10;  // of processor time, for one order
constexpr std::size_t kUsualQueue = 64;
constexpr std::size_t kMostQueued = 10'000;
constexpr std::size_t kMostWorkers = 1024;
constexpr std::size_t kConnections = 1024;

// How long orders are answered after the end was asked for.
constexpr milliseconds kEndTime{30'000};
// How often it is asked.
constexpr milliseconds kPause{50};

// Options that no answer depends on.
constexpr std::array<std::string_view, 8> kServerOptions = {
    "--listen", "--host",     "--workers",    "--queue",
    "--quiet",  "--max-time", "--max-memory", "--threads"};

// Processor time of one order, in whole seconds.
unsigned seconds_of(const ProcessLimits& limits) {
  if (!std::isfinite(limits.seconds)) return kUsualSeconds;
  return static_cast<unsigned>(std::clamp(std::ceil(limits.seconds), 1.0, 1e6));
}

std::string with_slash(std::string folder) {
  if (!folder.ends_with('/')) folder += '/';
  return folder;
}

// Lets this process have a descriptor for each connection.
void raise_descriptor_limit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

// What one of `count` orders may take, so that all of them together stay below
// the limit.
std::uint64_t share_of(const MemoryLimit& limit, std::size_t count) {
  const std::uint64_t all =
      limit.bytes > 0
          ? limit.bytes
          : static_cast<std::uint64_t>(limit.share *
                                       static_cast<double>(machine_memory()));
  return all / (count + 1);
}

class ServeCommand : public Command {
 public:
  std::string_view help() const override { return kServeHelp; }

  void add_options(OptionList& options) override {
    options_ = &options;
    options.text("--listen", "address",
                 [this](const std::string& text) { address_ = text; });
    options.names("--host", "name", hosts_).repeatable();
    options.whole("--workers", workers_, 1, kMostWorkers);
    options.whole("--queue", queue_, 0, kMostQueued);
    add_print_options(options, request_);
    add_machine_options(options, request_);
    add_strict_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
  }

  void check() override {
    for (const GivenOption& option : options_->given()) {
      if (option.name == "--root") root_ = option.words.front();
    }
    settings_ = given_text(*options_, kServerOptions);
    refuse_if(root_.empty(), "serve needs --root FOLDER, with the designs");
    refuse_if(!request_.job.heights.empty(),
              "serve needs whole layers, not --heights");
    refuse_if(!request_.design.parameter_file.empty(),
              "an order has the values of parameters, not -p");
    // An order is one of many: it has one thread.
    request_.job.threads = 1;
    request_.design.path = root_;
    compiler::validate(request_);
    try {
      listener_ = http::open_listener(http::parse_address(address_));
    } catch (const FileError& error) {
      throw RequestError(error.what());
    }
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    return run_caught(terminal, {}, [&] { return serve(context, terminal); });
  }

 private:
  std::size_t workers() const {
    const unsigned all = std::max(1U, std::thread::hardware_concurrency());
    return std::min<std::size_t>(workers_.value_or(all), kMostWorkers);
  }

  shop::ShopOptions options_for(const Context& context) const {
    const ProcessLimits& limits = context.watch.limits();
    shop::ShopOptions options;
    shop::DesignOptions& designs = options.designs;
    designs.request = serve::with_known_names(request_, context.file_access());
    designs.names = serve::known_names(designs.request, {});
    designs.settings = settings_;
    designs.folder = with_slash(root_);
    designs.evaluation_stack = context.stack / 2;
    designs.most_seconds = seconds_of(limits);
    options.workers = workers();
    options.queue = queue_.value_or(kUsualQueue);
    designs.most_bytes = share_of(limits.memory, options.workers);
    return options;
  }

  int serve(const Context& context, Terminal& terminal) {
    context.watch.time_parts();
    context.interrupt.hear_termination();
    raise_descriptor_limit();
    Diagnostics diagnostics(
        [&](const Diagnostic& message) { terminal.show(message); });
    http::Limits limits;
    limits.connections = kConnections;
    const auto server = http::make_server(limits,
                                          {.peers = http::Peers::kPrograms,
                                           .hosts = hosts_,
                                           .has_problems = true},
                                          module_folders(), diagnostics);
    shop::Shop shop(options_for(context), *server, context.temporary_files);
    const http::Address address = http::address_of(listener_);
    server->listen(std::move(listener_));
    print_out(address.path.empty()
                  ? fmt::format("http://{}\n", http::text_of(address))
                  : address.path + "\n");
    const std::function<void()> look = [&] {
      if (context.interrupt.asks_to_end()) return shop.end(kEndTime);
      server->after(kPause, look);
    };
    look();
    server->run([&](const http::Request& request,
                    const std::shared_ptr<http::Reply>& reply) {
      shop.answer(request, reply);
    });
    return kDone;
  }

  const OptionList* options_ = nullptr;  // until check() has been called
  std::string settings_;
  compiler::Request request_;
  bool is_quiet_ = false;
  std::string root_;
  std::string address_ = kUsualAddress;
  std::vector<std::string> hosts_;
  std::optional<unsigned> workers_;
  std::optional<unsigned> queue_;
  OpenFile listener_;
};

}  // namespace

std::unique_ptr<Command> make_serve_command() {
  return std::make_unique<ServeCommand>();
}

}  // namespace lamina::cli
