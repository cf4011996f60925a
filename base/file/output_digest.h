#pragma once
// What stands where an output goes: whether an earlier run has made it, and
// whether it still is what that run made.

#include <cstdint>
#include <optional>
#include <string>

#include "base/file/file_access.h"

namespace lamina {

struct OutputDigest {
  std::uint64_t bytes = 0;
  std::string digest;  // of all bytes; of a folder, of its files by name
};

// Of a file, or of a folder of files. No value where there is none, or where it
// cannot be read. It counts as no input of the run.
std::optional<OutputDigest> digest_of_output(const std::string& path,
                                             const FileAccess& access);

}  // namespace lamina
