#pragma once
// Runs programs as a user would: arguments in, streams and exit status out.

#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace lamina::support {

struct ProcessResult {
  int status = 0;  // exit status; 128 + n if signal n ended the process
  std::string output;
  std::string errors;
  long peak_memory_kib = 0;
};

// Runs `arguments` (the program first) in `folder` and waits for its end.
ProcessResult run_process(const std::vector<std::string>& arguments,
                          const std::string& folder = ".");

// Whether this machine has terminals to run programs on; some containers have
// none.
bool has_terminals();

// run_process() on a terminal of 80 columns; `output` is all that it shows.
// When it shows `cue`, Ctrl-C is pressed; the terminal adds no "^C" of its own.
ProcessResult run_on_terminal(const std::vector<std::string>& arguments,
                              const std::string& folder,
                              const std::string& cue = "");

// A process under way. Its standard error goes to the file `errors`.
class BackgroundProcess {
 public:
  BackgroundProcess(const std::vector<std::string>& arguments,
                    const std::string& folder,
                    const std::string& errors = "/dev/null");

  void send(int signal) const;
  // Waits for its end; the status as in ProcessResult.
  int wait();

 private:
  pid_t process_;
};

// Waits until `holds` returns true. Returns false after 60 s, which is a
// failure even on a busy machine.
bool wait_until(const std::function<bool()>& holds);

}  // namespace lamina::support
