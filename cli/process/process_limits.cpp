#include "cli/process/process_limits.h"

#include <cmath>
#include <optional>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "base/number.h"
#include "cli/options/option_values.h"

namespace lamina::cli {
namespace {

constexpr double kGreatestSeconds = 1e9;

constexpr double kGreatestBytes = 1e18;

// 0: no unit is named so.
double bytes_of_unit(char unit) {
  switch (unit) {
    case 'k':
    case 'K':
      return 1024;
    case 'm':
    case 'M':
      return 1024.0 * 1024;
    case 'g':
    case 'G':
      return 1024.0 * 1024 * 1024;
    default:
      return 0;
  }
}

}  // namespace

MemoryLimit parse_memory_limit(const std::string& text) {
  std::string_view number = text;
  const char last = text.empty() ? '\0' : text.back();
  const bool is_share = last == '%';
  const double unit = bytes_of_unit(last);
  if (is_share || unit > 0) number.remove_suffix(1);
  const std::optional<double> value = parse_number(number);
  if (!value) {
    throw CLI::ValidationError(
        "--max-memory",
        fmt::format("a size was expected, such as 500M, 2G or 50%, not '{}'",
                    text));
  }
  MemoryLimit limit;
  if (is_share) {
    limit.share = *value / 100;
    if (limit.share > 0 && limit.share <= 1) return limit;
    throw CLI::ValidationError(
        "--max-memory",
        fmt::format("must be more than 0% and at most 100%, not {}", text));
  }
  const double bytes = std::floor(*value * (unit > 0 ? unit : 1));
  if (!(bytes >= 1 && bytes <= kGreatestBytes)) {
    throw CLI::ValidationError(
        "--max-memory", fmt::format("must be from 1 to {:g} bytes, not {}",
                                    kGreatestBytes, text));
  }
  limit.bytes = static_cast<std::uint64_t>(bytes);
  return limit;
}

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

void add_process_limits(CLI::App& app, ProcessLimits& limits) {
  add_text(app, "--max-memory", "size", [&limits](const std::string& text) {
    limits.memory = parse_memory_limit(text);
  });
  add_text(app, "--max-time", "seconds", [&limits](const std::string& text) {
    limits.seconds = require_number("--max-time", text);
    if (!(limits.seconds > 0 && limits.seconds <= kGreatestSeconds)) {
      throw CLI::ValidationError(
          "--max-time", fmt::format("must be more than 0 and at most {:g} s, "
                                    "not {}",
                                    kGreatestSeconds, text));
    }
  });
}

}  // namespace lamina::cli
