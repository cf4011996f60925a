#pragma once
// What stands where an output goes: whether an earlier run has made it, and
// whether it still is what that run made.

#include <cstdint>
#include <optional>
#include <string>

#include "base/file/file_access.h"

namespace lamina {

struct OutputSize {
  std::uint64_t bytes = 0;  // of a folder: 0
  bool is_folder = false;
};

// No value where no file and no folder stands there.
std::optional<OutputSize> size_of_output(const std::string& path,
                                         const FileAccess& access);

// Of all bytes of the file; empty where there is none, or it cannot be read,
// and for folders. It counts as no input of the run.
std::string digest_of_output(const std::string& path, const FileAccess& access);

}  // namespace lamina
