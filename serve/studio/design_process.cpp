#include "serve/studio/design_process.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "compiler/compile.h"
#include "compiler/validate.h"
#include "serve/studio/frames.h"
#include "serve/studio/run.h"

namespace lamina::studio {
namespace {

// The head of a command; the page's request follows.
struct Head {
  Lane lane = Lane::kShown;
  bool is_source = false;
  bool starts = false;  // else it ends the lane's run
};

constexpr std::size_t kMostFiles = 2;  // of a command: the pipe, the output

// A command and the descriptors that came with it.
struct Command {
  Head head;
  std::string body;
  std::vector<OpenFile> files;
};

// Sends a command; false where nobody takes it.
bool send_command(int socket, Head head, const std::string& body,
                  const std::vector<int>& files) {
  std::array<iovec, 2> parts = {
      iovec{&head, sizeof head},
      iovec{const_cast<char*>(body.data()), body.size()}};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostFiles * sizeof(int))>
      control{};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  if (!files.empty()) {
    message.msg_control = control.data();
    message.msg_controllen = CMSG_SPACE(files.size() * sizeof(int));
    cmsghdr* const head_of_files = CMSG_FIRSTHDR(&message);
    head_of_files->cmsg_level = SOL_SOCKET;
    head_of_files->cmsg_type = SCM_RIGHTS;
    head_of_files->cmsg_len = CMSG_LEN(files.size() * sizeof(int));
    std::memcpy(CMSG_DATA(head_of_files), files.data(),
                files.size() * sizeof(int));
  }
  return ::sendmsg(socket, &message, MSG_NOSIGNAL) >= 0;
}

// No value when the studio has ended.
std::optional<Command> receive_command(int socket, std::string& buffer) {
  Command command;
  std::array<iovec, 2> parts = {iovec{&command.head, sizeof command.head},
                                iovec{buffer.data(), buffer.size()}};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostFiles * sizeof(int))>
      control{};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  if (size < static_cast<ssize_t>(sizeof command.head)) return std::nullopt;
  command.body =
      buffer.substr(0, static_cast<std::size_t>(size) - sizeof command.head);
  const cmsghdr* const files = CMSG_FIRSTHDR(&message);
  if (files != nullptr && files->cmsg_type == SCM_RIGHTS) {
    const std::size_t count = (files->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int file = -1;
      std::memcpy(&file, CMSG_DATA(files) + i * sizeof(int), sizeof file);
      command.files.emplace_back(file);
    }
  }
  return command;
}

// Closes all descriptors of this process but the standard streams and these:
// else connections would live on here that the studio has closed.
void close_all_but(std::set<int> kept) {
  unsigned next = STDERR_FILENO + 1;
  for (const int file : kept) {
    const auto kept_file = static_cast<unsigned>(file);
    if (kept_file > next) ::close_range(next, kept_file - 1, 0);
    next = std::max(next, kept_file + 1);
  }
  ::close_range(next, ~0U, 0);
}

std::string words_of(ChildFault fault) {
  switch (fault) {
    case ChildFault::kOutOfTime:
      return "out of time: --max-time gives it more";
    case ChildFault::kOutOfMemory:
      return "out of memory: --max-memory gives it more";
    case ChildFault::kCrashed:
      return "internal error, please report: the run crashed";
    case ChildFault::kNone:
    case ChildFault::kKilled:
      break;
  }
  return "the run was ended by the system";
}

// What the process of a design does.
class DesignLoop {
 public:
  DesignLoop(const DesignProcess::Options& options, int commands)
      : options_(options),
        commands_(commands),
        temporary_files_(options.temporary_files.file_access()),
        design_(options.request, temporary_files_) {}

  void run() {
    read();
    std::string buffer(1 << 17, '\0');
    while (true) {
      wait();
      end_finished_runs();
      if (!can_read_command_) continue;
      std::optional<Command> command = receive_command(commands_, buffer);
      if (!command) return;
      lanes_[index_of(command->head.lane)].reset();
      if (command->head.starts && !command->files.empty()) {
        start(std::move(*command));
      }
    }
  }

 private:
  struct Run {
    std::unique_ptr<ChildProcess> process;
    OpenFile output;  // the pipe of frames
    Choice choice;
    bool sends_events = true;
  };

  static std::size_t index_of(Lane lane) {
    return static_cast<std::size_t>(lane) % kLanes;
  }

  // Parses the design, and makes its form. Where that fails, each run does it
  // again and says why.
  void read() {
    design_.evaluation_stack = options_.evaluation_stack;
    try {
      compiler::read_design(design_);
      form_ = form_of(design_.design.program, options_.request.design.path,
                      design_.file_access(), design_.diagnostics);
    } catch (const Error&) {
    }
  }

  void wait() {
    std::vector<pollfd> files = {{commands_, POLLIN, 0}};
    for (const std::optional<Run>& run : lanes_) {
      if (run) files.push_back({run->process->descriptor(), POLLIN, 0});
    }
    ::poll(files.data(), files.size(), -1);
    can_read_command_ = files.front().revents != 0;
  }

  // Says of a run that did not end by itself why, and lets go of all that have
  // ended: their pipes end.
  void end_finished_runs() {
    for (std::optional<Run>& run : lanes_) {
      if (!run) continue;
      pollfd end = {run->process->descriptor(), POLLIN, 0};
      if (::poll(&end, 1, 0) == 0) continue;
      const ChildFault fault = run->process->wait();
      if (fault != ChildFault::kNone) send_fault(*run, fault);
      run.reset();
    }
  }

  void send_fault(const Run& run, ChildFault fault) {
    Diagnostic why{Severity::kError, {}, words_of(fault)};
    const std::string messages = messages_json({why}, "");
    const int output = run.output.descriptor();
    if (!run.sends_events) {
      write_frame(output, FrameKind::kAnswer,
                  fmt::format(R"(422 {{"messages":{}}})", messages));
      return;
    }
    const std::uint64_t number = run.choice.number;
    write_frame(output, FrameKind::kEvent, messages_event(number, messages));
    write_frame(output, FrameKind::kLast, end_event(number, false, -1, 0));
  }

  void start(Command command) {
    Run& run = lanes_[index_of(command.head.lane)].emplace();
    run.choice = read_choice(command.body);
    run.sends_events = run.choice.format.empty() && !command.head.is_source;
    run.output = std::move(command.files.front());
    const int output = run.output.descriptor();
    const int file =
        command.files.size() > 1 ? command.files.back().descriptor() : -1;
    run.process = std::make_unique<ChildProcess>(
        [&](const ChildOutput&) {
          ::close(commands_);
          if (file >= 0) ::dup2(file, STDOUT_FILENO);
          work(run.choice, command.head.is_source, output);
        },
        options_.most_seconds);
  }

  // In the process of the run.
  void work(const Choice& choice, bool is_source, int output) {
    compiler::Request request =
        request_of(choice, options_.request, options_.names);
    if (is_source) {
      write_source(design_, choice, output);
    } else if (can_go_on(request)) {
      design_.request = std::move(request);
      make(design_, choice, &*form_, output);
    } else {
      compiler::Compilation anew(std::move(request), temporary_files_);
      anew.evaluation_stack = options_.evaluation_stack;
      make(anew, choice, nullptr, output);
    }
  }

  // Whether the design as it was read is that of the request.
  bool can_go_on(const compiler::Request& request) const {
    return !options_.reads_anew && form_ && !request.supports &&
           !request.sprues && request.geometry.searched_direction == 0;
  }

  static void make(compiler::Compilation& compilation, const Choice& choice,
                   const Form* form, int output) {
    if (choice.format.empty()) {
      show_choice(compilation, choice, form, output);
    } else {
      write_output(compilation, choice, output);
    }
  }

  const DesignProcess::Options& options_;
  const int commands_;
  // Its own: another thread may have held those of the studio when this process
  // was copied.
  TemporaryFiles temporary_files_;
  compiler::Compilation design_;
  std::optional<Form> form_;  // of the design, if it could be read
  std::array<std::optional<Run>, kLanes> lanes_;
  bool can_read_command_ = false;
};

}  // namespace

DesignProcess::DesignProcess(const Options& options) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) !=
      0) {
    throw Error(fmt::format("the system grants no further socket: {}",
                            std::strerror(errno)));
  }
  commands_ = OpenFile(ends[0]);
  const OpenFile other(ends[1]);
  constexpr unsigned kAnyTime = ~0U >> 1U;  // it waits most of the time
  process_ = std::make_unique<ChildProcess>(
      [&](const ChildOutput& output) {
        std::set<int> kept = {other.descriptor(), output.descriptor()};
        for (const int folder :
             options.temporary_files.file_access().folder_descriptors()) {
          kept.insert(folder);
        }
        close_all_but(std::move(kept));
        DesignLoop(options, other.descriptor()).run();
      },
      kAnyTime);
}

OpenFile DesignProcess::start(Lane lane, const std::string& body,
                              bool is_source, int file) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return OpenFile();
  OpenFile output(ends[0]);
  const OpenFile input(ends[1]);
  std::vector<int> files = {input.descriptor()};
  if (file >= 0) files.push_back(file);
  const Head head{.lane = lane, .is_source = is_source, .starts = true};
  if (!send_command(commands_.descriptor(), head, body, files)) {
    return OpenFile();
  }
  return output;
}

void DesignProcess::end(Lane lane) {
  send_command(commands_.descriptor(), {.lane = lane}, "", {});
}

}  // namespace lamina::studio
