#include "tests/support/process.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace lamina::support {
namespace {

// For execvp; valid as long as the arguments.
std::vector<char*> words_of(const std::vector<std::string>& arguments) {
  std::vector<char*> words;
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  return words;
}

// Starts the program with its streams going to files.
pid_t start(const std::vector<std::string>& arguments,
            const std::string& folder, const std::string& output,
            const std::string& errors) {
  const std::vector<char*> words = words_of(arguments);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("fork failed");
  if (process > 0) return process;
  const auto redirect = [](const std::string& path, int stream) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, stream);
    ::close(file);
  };
  redirect(output, STDOUT_FILENO);
  redirect(errors, STDERR_FILENO);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  ::execvp(words[0], words.data());
  ::_exit(127);
}

int status_of(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status)
                                : 128 + WTERMSIG(wait_status);
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::string& folder) {
  const TemporaryFolder streams;
  const pid_t process =
      start(arguments, folder, streams.file("out"), streams.file("err"));
  int wait_status = 0;
  rusage usage{};
  ::wait4(process, &wait_status, 0, &usage);
  return {status_of(wait_status), read_file(streams.file("out")),
          read_file(streams.file("err")), usage.ru_maxrss};
}

bool has_terminals() {
  int terminal = -1;
  int other_end = -1;
  if (::openpty(&terminal, &other_end, nullptr, nullptr, nullptr) != 0) {
    return false;
  }
  ::close(terminal);
  ::close(other_end);
  return true;
}

ProcessResult run_on_terminal(const std::vector<std::string>& arguments,
                              const std::string& folder,
                              const std::string& cue) {
  const std::vector<char*> words = words_of(arguments);
  const winsize size = {24, 80, 0, 0};
  int terminal = -1;
  const pid_t process = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (process < 0) throw std::runtime_error("forkpty failed");
  if (process == 0) {
    termios modes{};
    ::tcgetattr(STDIN_FILENO, &modes);
    modes.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &modes);
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    ::execvp(words[0], words.data());
    ::_exit(127);
  }
  std::string shown;
  bool is_pressed = cue.empty();
  char buffer[4096];
  // A terminal whose last user is gone reads as an error.
  for (ssize_t count; (count = ::read(terminal, buffer, sizeof buffer)) > 0;) {
    shown.append(buffer, static_cast<std::size_t>(count));
    if (is_pressed || shown.find(cue) == std::string::npos) continue;
    is_pressed = ::write(terminal, "\x03", 1) == 1;
  }
  ::close(terminal);
  int wait_status = 0;
  rusage usage{};
  ::wait4(process, &wait_status, 0, &usage);
  return {status_of(wait_status), shown, "", usage.ru_maxrss};
}

BackgroundProcess::BackgroundProcess(const std::vector<std::string>& arguments,
                                     const std::string& folder,
                                     const std::string& errors)
    : process_(start(arguments, folder, "/dev/null", errors)) {}

void BackgroundProcess::send(int signal) const { ::kill(process_, signal); }

int BackgroundProcess::wait() {
  int wait_status = 0;
  ::waitpid(process_, &wait_status, 0);
  return status_of(wait_status);
}

bool wait_until(const std::function<bool()>& holds) {
  for (int i = 0; i < 6000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace lamina::support
