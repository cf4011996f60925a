#pragma once
// Runs the passes on a stack large enough for any design, and ends the run
// cleanly when it is interrupted.
//
// The passes run on a thread of their own (cli/large_stack.h). The first thread
// meanwhile waits for signals; being an ordinary thread and not a signal
// handler, it may take locks and remove temporary files.

#include <cstddef>
#include <functional>

#include "slicer/formats/output_file.h"

namespace lamina::cli {

// Runs `work` with the stack's size in bytes and returns its result, an exit
// status. On SIGINT, SIGTERM or SIGHUP it discards the temporary files and
// ends the process with status 130.
int run_on_stack(slicer::TemporaryFiles& temporary_files,
                 const std::function<int(std::size_t stack_bytes)>& work);

}  // namespace lamina::cli
