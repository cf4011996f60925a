#pragma once
// What a process may take: time and memory.

#include <cstdint>
#include <limits>
#include <string>

namespace lamina::cli {

// Bytes, or a share of the machine's memory.
struct MemoryLimit {
  std::uint64_t bytes = 0;  // 0: the share counts
  double share = 0.8;
};

// "500 MiB": the largest unit of which it is not a small part.
std::string memory_size_text(std::uint64_t bytes);

struct ProcessLimits {
  MemoryLimit memory;
  // Wall time of the run, or of each piece where there are several.
  double seconds = std::numeric_limits<double>::infinity();
};

}  // namespace lamina::cli
