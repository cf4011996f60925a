#include "cli/process/process_limits.h"

#include <fmt/format.h>

namespace lamina::cli {

std::string memory_size_text(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  constexpr double kStep = 1024;
  if (size < kStep) return fmt::format("{} bytes", bytes);
  if (size < kStep * kStep) return fmt::format("{:.4g} KiB", size / kStep);
  if (size < 10 * kStep * kStep * kStep) {
    return fmt::format("{:.0f} MiB", size / kStep / kStep);
  }
  return fmt::format("{:.1f} GiB", size / kStep / kStep / kStep);
}

}  // namespace lamina::cli
