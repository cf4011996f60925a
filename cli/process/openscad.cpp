#include "cli/process/openscad.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/diagnostic.h"

namespace lamina::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMissingStatus = 127;
constexpr std::size_t kLastWords = 6;  // lines of a failed run that are shown

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// In the child: becomes the program, its streams in `words`.
[[noreturn]] void become(char* const* arguments, const char* words) {
  // It ends with this program, however that ends.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  ::signal(SIGXFSZ, SIG_DFL);
  const int in = ::open("/dev/null", O_RDONLY);
  const int out = ::open(words, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::execvp(arguments[0], arguments);
  ::_exit(kMissingStatus);
}

// Waits for the child; ends it after `limit` seconds and returns no value then.
std::optional<int> wait_for(pid_t child, double limit) {
  const Clock::time_point begin = Clock::now();
  auto pause = std::chrono::milliseconds(1);
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (seconds_since(begin) > limit) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return std::nullopt;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds(50));
  }
  return status;
}

// The status as waitpid() has it; no value where the limit [s] ended it.
// Throws FileError where there is no openscad.
std::optional<int> run_openscad(std::vector<std::string> arguments,
                                const std::string& words, double limit) {
  arguments.insert(arguments.begin(), "openscad");
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) {
    throw FileError(
        fmt::format("openscad cannot be started: {}", std::strerror(errno)));
  }
  if (child == 0) become(pointers.data(), words.c_str());
  const std::optional<int> status = wait_for(child, limit);
  if (status && WIFEXITED(*status) && WEXITSTATUS(*status) == kMissingStatus) {
    throw FileError(
        "openscad is not installed: there is no program of that name in the "
        "PATH");
  }
  return status;
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

std::string last_words(const std::string& path) {
  const std::vector<std::string> lines = lines_of(path);
  std::string words;
  for (std::size_t i = lines.size() - std::min(lines.size(), kLastWords);
       i < lines.size(); ++i) {
    words += "\n  " + lines[i];
  }
  return words;
}

}  // namespace

ScratchFolder::ScratchFolder(TemporaryFiles& temporary_files)
    : temporary_files_(temporary_files) {
  std::error_code error;
  const std::filesystem::path parent =
      std::filesystem::temp_directory_path(error);
  if (error) {
    throw FileError(fmt::format(
        "there is no folder for openscad's mesh: TMPDIR: {}", error.message()));
  }
  const std::string beside = (parent / "lamina").string();
  folder_ = temporary_files_.make_folder(beside);
  if (folder_.lock < 0) {
    throw FileError(fmt::format("no folder can be made beside '{}': {}", beside,
                                std::strerror(errno)));
  }
}

ScratchFolder::~ScratchFolder() { temporary_files_.discard_folder(folder_); }

std::string openscad_version(TemporaryFiles& temporary_files) {
  constexpr double kLimit = 60;  // seconds
  const ScratchFolder folder(temporary_files);
  const std::string words = folder.file("version");
  run_openscad({"--version"}, words, kLimit);
  const std::vector<std::string> lines = lines_of(words);
  return lines.empty() ? "openscad" : lines.back();
}

std::string language_of(std::string_view version) {
  constexpr int kLastYearOfReleases = 2021;
  const std::size_t digits = version.find_first_of("0123456789");
  int year = 0;
  if (digits != std::string_view::npos) {
    std::from_chars(version.data() + digits, version.data() + version.size(),
                    year);
  }
  return year > kLastYearOfReleases ? "2026" : "2021";
}

OpenScadMesh render_with_openscad(const compiler::Request& request,
                                  double time_limit,
                                  const ScratchFolder& folder) {
  OpenScadMesh mesh;
  mesh.path = folder.file("openscad.stl");
  std::vector<std::string> arguments = {"-o", mesh.path, "--export-format",
                                        "binstl"};
  const auto pass_on = [&](const char* option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  pass_on("-D", request.design.definitions);
  pass_on("-p", request.design.parameter_file);
  pass_on("-P", request.design.parameter_set);
  arguments.push_back(request.design.path);

  const std::string words = folder.file("words");
  const Clock::time_point begin = Clock::now();
  const std::optional<int> status =
      run_openscad(std::move(arguments), words, time_limit);
  mesh.seconds = seconds_since(begin);
  if (!status) {
    throw FileError(fmt::format(
        "openscad took more than {:g} s on {} and was ended; --time-limit "
        "gives it more",
        time_limit, request.design.path));
  }
  if (WIFSIGNALED(*status)) {
    throw FileError(fmt::format("openscad crashed on {} (signal {}){}",
                                request.design.path, WTERMSIG(*status),
                                last_words(words)));
  }
  if (*status != 0 || !std::filesystem::exists(mesh.path)) {
    throw FileError(fmt::format("openscad made no mesh of {}{}",
                                request.design.path, last_words(words)));
  }
  return mesh;
}

}  // namespace lamina::cli
