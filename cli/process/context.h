#pragma once
// What a command gets from its process.

#include <cstddef>

#include "base/file/output_file.h"
#include "cli/process/process_watch.h"

namespace lamina::cli {

struct Context {
  TemporaryFiles& temporary_files;
  std::size_t stack;  // bytes, of the thread that runs the command
  ProcessWatch& watch;

  const FileAccess& file_access() const {
    return temporary_files.file_access();
  }
};

}  // namespace lamina::cli
