#include "cli/process/streams.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/file/open_file.h"
#include "base/file/output_file.h"
#include "base/text.h"

namespace lamina::cli {
namespace {

bool shows_colours() {
  const auto is_set = [](const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  static const bool shows = ::isatty(STDERR_FILENO) == 1 &&
                            !is_set("NO_COLOR") && is_set("TERM") &&
                            std::string_view(std::getenv("TERM")) != "dumb";
  return shows;
}

// The colours of GCC's messages.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4>
    kColours = {{{"error:", "\x1b[1;31m"},
                 {"warning:", "\x1b[1;35m"},
                 {"deprecated:", "\x1b[1;35m"},
                 {"note:", "\x1b[1;36m"}}};

// Of each line, the first word that says what it is: at its beginning, or
// behind a place.
std::string coloured(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::string_view line =
        text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    text.remove_prefix(line.size());
    std::size_t at = line.size();
    std::size_t length = 0;
    std::string_view colour;
    for (const auto& [word, its_colour] : kColours) {
      const std::size_t found = line.find(word);
      if (found >= at) continue;
      if (found > 0 && line.substr(0, found).substr(found - 2) != ": ")
        continue;
      at = found;
      length = word.size();
      colour = its_colour;
    }
    result += line.substr(0, at);
    if (at == line.size()) continue;
    result += fmt::format("{}{}\x1b[m", colour, line.substr(at, length));
    result += line.substr(at + length);
  }
  return result;
}

}  // namespace

void open_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest number that is free is this one.
    if (::open("/", O_PATH) < 0) return;
  }
}

void print_out(std::string_view text) {
  const int error = write_all(STDOUT_FILENO, without_controls(text));
  if (error == EPIPE) throw ReaderGone();
  if (error != 0) fail_to_write("-", error);
}

void print_messages(std::string_view text) {
  const std::string shown =
      shows_colours() ? coloured(text) : std::string(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
}

void print_error(std::string_view text) { write_all(STDERR_FILENO, text); }

}  // namespace lamina::cli
