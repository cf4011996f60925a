#pragma once
// `--watch`: makes an output anew whenever the design or a file that it depends
// on changes.

#include <string>

#include "cli/process/context.h"
#include "compiler/request.h"

namespace lamina::cli {

// Goes on until an interrupt or an exceeded limit ends the process. Where the
// design fails, the output stays as it was.
//
// report  path of --report; empty: none
// throws  FileError where files cannot be watched
[[noreturn]] void compile_and_watch(const compiler::Request& request,
                                    const std::string& report, bool is_quiet,
                                    const Context& context);

}  // namespace lamina::cli
