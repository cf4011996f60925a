#pragma once
// `--watch`: makes an output anew whenever the design or a file that it depends
// on changes.

#include <cstddef>

#include "base/file/output_file.h"
#include "cli/process/process_watch.h"
#include "compiler/design_options.h"

namespace lamina::cli {

// Goes on until an interrupt or an exceeded limit ends the process. Where the
// design fails, the output stays as it was.
//
// watch   times each run by itself
// throws  FileError where files cannot be watched
[[noreturn]] void compile_and_watch(const DesignOptions& options,
                                    TemporaryFiles& temporary_files,
                                    std::size_t stack, ProcessWatch& watch);

}  // namespace lamina::cli
