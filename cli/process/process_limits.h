#pragma once
// What a process may take: time and memory, and the options that say so.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <CLI/App.hpp>

namespace lamina::cli {

// Bytes, or a share of the machine's memory.
struct MemoryLimit {
  std::uint64_t bytes = 0;  // 0: the share counts
  double share = 0.8;
};

// "500M", "2G", "1.5g", "800000k", "123456789" or "50%": K, M and G are powers
// of 1024. Throws CLI::ValidationError for all other texts.
MemoryLimit parse_memory_limit(const std::string& text);

// "500 MiB": the largest unit of which it is not a small part.
std::string memory_size_text(std::uint64_t bytes);

struct ProcessLimits {
  MemoryLimit memory;
  // Wall time of the run, or of each piece where there are several.
  double seconds = std::numeric_limits<double>::infinity();
};

// --max-time and --max-memory, which all commands have.
void add_process_limits(CLI::App& app, ProcessLimits& limits);

}  // namespace lamina::cli
