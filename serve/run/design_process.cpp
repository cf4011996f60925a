#include "serve/run/design_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "compiler/compile.h"

namespace lamina::serve {
namespace {

// The head of a message to the process; the command's body follows.
struct Head {
  std::uint64_t run = 0;
  bool starts = false;  // else the run ends
  char kind = 0;
};

constexpr std::size_t kMostFiles = 2;  // of a message: the pipe, the output

// A message and the descriptors that came with it.
struct Received {
  Head head;
  std::string body;
  std::vector<OpenFile> files;
};

// Sends a command; false where nobody takes it, or not fast enough.
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
  return ::sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

// No value when the studio has ended.
std::optional<Received> receive_command(int socket, std::string& buffer) {
  Received command;
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

// Lets this process have so many bytes that it may write to, if it may.
void limit_memory(std::uint64_t most_bytes) {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, most_bytes);
  ::setrlimit(RLIMIT_DATA, &limit);
}

// What the process of a design does.
class DesignLoop {
 public:
  DesignLoop(const DesignProcess::Options& options, int commands, int output,
             std::uint64_t most_writable)
      : options_(options),
        commands_(commands),
        output_(output),
        most_writable_(most_writable),
        temporary_files_(options.temporary_files.file_access()),
        design_(options.request, temporary_files_) {}

  void run() {
    read();
    std::string buffer(kMostBody + sizeof(Head), '\0');
    while (true) {
      wait();
      end_finished_runs();
      if (!can_read_command_) continue;
      std::optional<Received> message = receive_command(commands_, buffer);
      if (!message) return;
      if (message->head.starts && !message->files.empty()) {
        start(std::move(*message));
      } else {
        std::erase_if(runs_, [&](const Run& run) {
          return run.number == message->head.run;
        });
      }
    }
  }

 private:
  struct Run {
    std::uint64_t number = 0;
    Command command;
    OpenFile output;  // the pipe of frames
    std::unique_ptr<ChildProcess> process;
  };

  // Parses the design. Where that fails, each run does it again and says why.
  void read() {
    design_.evaluation_stack = options_.evaluation_stack;
    try {
      compiler::read_design(design_);
    } catch (const Error&) {
    }
    options_.work.take_design(design_, output_);
  }

  void wait() {
    std::vector<pollfd> files = {{commands_, POLLIN, 0}};
    for (const Run& run : runs_) {
      files.push_back({run.process->descriptor(), POLLIN, 0});
    }
    ::poll(files.data(), files.size(), -1);
    can_read_command_ = files.front().revents != 0;
  }

  // Says of a run that did not end by itself why, and lets go of all that have
  // ended: their pipes end.
  void end_finished_runs() {
    std::erase_if(runs_, [&](const Run& run) {
      pollfd end = {run.process->descriptor(), POLLIN, 0};
      if (::poll(&end, 1, 0) == 0) return false;
      const ChildFault fault = run.process->wait();
      if (fault != ChildFault::kNone) {
        options_.work.report_fault(run.command, fault, run.output.descriptor());
      }
      return true;
    });
  }

  void start(Received message) {
    Run run{.number = message.head.run,
            .command = {message.head.kind, std::move(message.body)},
            .output = std::move(message.files.front()),
            .process = nullptr};
    const int file =
        message.files.size() > 1 ? message.files.back().descriptor() : -1;
    try {
      run.process = std::make_unique<ChildProcess>(
          [&](const ChildOutput&) {
            ::close(commands_);
            // Else the pipes of the others would end with this one.
            for (const Run& other : runs_) ::close(other.output.descriptor());
            if (most_writable_ > 0) limit_memory(most_writable_);
            if (file >= 0) ::dup2(file, STDOUT_FILENO);
            options_.work.run(design_, run.command, run.output.descriptor());
          },
          options_.most_seconds);
    } catch (const Error&) {
      // The system grants no process.
      options_.work.report_fault(run.command, ChildFault::kKilled,
                                 run.output.descriptor());
      return;
    }
    runs_.push_back(std::move(run));
  }

  const DesignProcess::Options& options_;
  const int commands_;
  const int output_;
  const std::uint64_t most_writable_;  // of a run [bytes]; 0: no limit
  // Its own: another thread may have held those of the server when this process
  // was copied.
  TemporaryFiles temporary_files_;
  compiler::Compilation design_;
  std::vector<Run> runs_;
  bool can_read_command_ = false;
};

}  // namespace

void go_on_from_read(compiler::Compilation& design, compiler::Request request,
                     bool reads_anew,
                     const std::function<void(compiler::Compilation&)>& work) {
  if (!reads_anew && !request.supports && !request.sprues &&
      request.geometry.searched_direction == 0) {
    design.request = std::move(request);
    return work(design);
  }
  compiler::Compilation anew(std::move(request), design.temporary_files);
  anew.evaluation_stack = design.evaluation_stack;
  work(anew);
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

DesignProcess::DesignProcess(const Options& options) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) !=
      0) {
    throw Error(fmt::format("the system grants no further socket: {}",
                            std::strerror(errno)));
  }
  commands_ = OpenFile(ends[0]);
  const OpenFile other(ends[1]);
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw Error(fmt::format("the system grants no further pipe: {}",
                            std::strerror(errno)));
  }
  output_ = OpenFile(ends[0]);
  const OpenFile input(ends[1]);
  // A copy of a process that is shut in cannot look at itself.
  const std::uint64_t most_writable =
      options.most_bytes == 0 ? 0 : writable_memory() + options.most_bytes;
  constexpr unsigned kAnyTime = ~0U >> 1U;  // it waits most of the time
  process_ = std::make_unique<ChildProcess>(
      [&](const ChildOutput& output) {
        std::set<int> kept = {other.descriptor(), input.descriptor(),
                              output.descriptor()};
        for (const int folder :
             options.temporary_files.file_access().folder_descriptors()) {
          kept.insert(folder);
        }
        close_all_but(std::move(kept));
        DesignLoop(options, other.descriptor(), input.descriptor(),
                   most_writable)
            .run();
      },
      kAnyTime);
}

DesignProcess::Run DesignProcess::start(const Command& command, int file) {
  Run run{.number = ++last_run_, .output = OpenFile()};
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return run;
  OpenFile output(ends[0]);
  const OpenFile input(ends[1]);
  std::vector<int> files = {input.descriptor()};
  if (file >= 0) files.push_back(file);
  const Head head{.run = run.number, .starts = true, .kind = command.kind};
  if (send_command(commands_.descriptor(), head, command.body, files)) {
    run.output = std::move(output);
  }
  return run;
}

void DesignProcess::end(std::uint64_t run) {
  send_command(commands_.descriptor(), {.run = run}, "", {});
}

}  // namespace lamina::serve
