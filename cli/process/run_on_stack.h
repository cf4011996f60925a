#pragma once
// Runs the passes on a stack large enough for any design, and ends the run
// cleanly when it is interrupted or takes too much.
//
// The passes run on a thread of their own (cli/process/large_stack.h). The
// first thread meanwhile waits for signals and looks at the limits
// (cli/process/process_watch.h); being an ordinary thread and not a signal
// handler, it may take locks and remove temporary files. It also ends the
// process after an exception that nobody can catch, such as a failed allocation
// in a library that cannot pass it on.

#include <cstddef>
#include <functional>

#include "base/file/output_file.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {

// Runs `work` with the stack's size in bytes and returns its result, an exit
// status. On SIGINT, SIGTERM or SIGHUP it discards the temporary files and
// ends the process with status 130; where a limit is exceeded, with a message
// and status 1. A message that nobody takes within a second is dropped.
int run_on_stack(TemporaryFiles& temporary_files, ProcessWatch& watch,
                 const std::function<int(std::size_t stack_bytes)>& work);

}  // namespace lamina::cli
