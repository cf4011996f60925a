#pragma once
// What stands where an output goes: whether an earlier run has made it, and
// whether it still is what that run made.

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "base/file/file_access.h"
#include "base/file/open_file.h"

namespace lamina {

struct OutputDigest {
  std::uint64_t bytes = 0;
  std::string digest;  // of all bytes; of a folder, of its files by name
};

// Digests a file, or a folder of files. No value where there is none, where it
// cannot be read, or where it has more than `most_bytes`, of which nothing is
// read. It does not count as an input of the run.
std::optional<OutputDigest> digest_of_output(
    const std::string& path, const FileAccess& access,
    std::uint64_t most_bytes = std::numeric_limits<std::uint64_t>::max());

// Digests all bytes of a file, block by block. No value where it cannot be read
// or changes meanwhile.
std::optional<OutputDigest> digest_of_file(const OpenFile& file);

// Whether the file may be another one than somebody has read who began then.
// Its time of change (ctime) is the machine's own: that of a file that is moved
// here is new, too.
bool has_changed_since(std::chrono::steady_clock::time_point begin,
                       const std::string& path, const FileAccess& access);

}  // namespace lamina
