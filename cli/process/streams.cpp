#include "cli/process/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include "base/file/open_file.h"
#include "base/file/output_file.h"
#include "base/text.h"

namespace lamina::cli {

void open_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest number that is free is this one.
    if (::open("/", O_PATH) < 0) return;
  }
}

void print_out(std::string_view text) {
  const int error = write_all(STDOUT_FILENO, without_controls(text));
  if (error != 0) fail_to_write("-", error);
}

void print_error(std::string_view text) { write_all(STDERR_FILENO, text); }

}  // namespace lamina::cli
