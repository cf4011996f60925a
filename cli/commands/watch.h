#pragma once
// `--watch`: makes an output anew whenever the design or a file that it depends
// on changes.

#include "cli/process/context.h"
#include "cli/report/run_report.h"
#include "compiler/request.h"

namespace lamina::cli {

// Goes on until an interrupt or an exceeded limit ends the process. Where the
// design fails, the output stays as it was.
//
// Throws FileError where files cannot be watched.
[[noreturn]] void compile_and_watch(const compiler::Request& request,
                                    const Closing& closing, bool is_quiet,
                                    const Context& context);

}  // namespace lamina::cli
