#pragma once
// What a command gets from its process.

#include <cstddef>
#include <initializer_list>
#include <string>

#include "base/file/output_file.h"
#include "cli/process/interrupt.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {

struct Context {
  TemporaryFiles& temporary_files;
  std::size_t stack;  // bytes, of the thread that runs the command
  ProcessWatch& watch;
  Interrupt& interrupt;

  const FileAccess& file_access() const {
    return temporary_files.file_access();
  }

  // Says what the command will write, before it does anything else. Throws as
  // RunFiles::expect_output() does; what is empty is not an output.
  void expect_outputs(std::initializer_list<std::string> paths) const {
    for (const std::string& path : paths) {
      file_access().run_files()->expect_output(path, file_access());
    }
  }
};

}  // namespace lamina::cli
