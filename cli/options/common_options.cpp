#include "cli/options/common_options.h"

#include <cmath>
#include <optional>
#include <string_view>

#include "base/text.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"

namespace lamina::cli {
namespace {

constexpr double kGreatestSeconds = 1e9;

constexpr double kGreatestBytes = 1e18;

// The bytes of a unit; 0 where no unit has this name.
double bytes_of_unit(char name) {
  constexpr std::string_view kNames = "kKmMgG";
  const std::size_t place = kNames.find(name);
  if (place == std::string_view::npos) return 0;
  return std::pow(1024, static_cast<double>(place / 2 + 1));
}

void add_process_limits(OptionList& options, ProcessLimits& limits) {
  options.text("--max-memory", "size", [&limits](const std::string& text) {
    limits.memory = parse_memory_limit(text);
  });
  options.text("--max-time", "seconds", [&limits](const std::string& text) {
    limits.seconds = require_number("--max-time", text);
    require(limits.seconds > 0 && limits.seconds <= kGreatestSeconds,
            "--max-time", "must be more than 0 and at most {:g} s, not {}",
            kGreatestSeconds, text);
  });
}

void add_access_limits(OptionList& options, FileAccess::Limits& access) {
  const Option root = options.name("--root", "folder", access.root);
  options.names("--allow-read", "folder", access.readable)
      .repeatable()
      .needs(root);
  options.flag("--no-import", access.refuses_data);
  // --watch looks at folders for as long as it runs, and --against runs a
  // program that knows no root.
  for (const char* name : {"--watch", "--against"}) {
    if (const auto option = options.find(name)) root.excludes(*option);
  }
}

}  // namespace

void add_common_options(OptionList& options, ProcessLimits& limits,
                        FileAccess::Limits& access) {
  options.help_and_version();
  add_process_limits(options, limits);
  add_access_limits(options, access);
}

MemoryLimit parse_memory_limit(const std::string& text) {
  std::string_view number = text;
  const char last = text.empty() ? '\0' : text.back();
  const bool is_share = last == '%';
  const double unit = bytes_of_unit(last);
  if (is_share || unit > 0) number.remove_suffix(1);
  const std::optional<double> value = parse_number(number);
  require(value.has_value(), "--max-memory",
          "a size was expected, such as 500M, 2G or 50%, not '{}'", text);
  MemoryLimit limit;
  if (is_share) {
    limit.share = *value / 100;
    require(limit.share > 0 && limit.share <= 1, "--max-memory",
            "must be more than 0% and at most 100%, not {}", text);
    return limit;
  }
  const double bytes = std::floor(*value * (unit > 0 ? unit : 1));
  require(bytes >= 1 && bytes <= kGreatestBytes, "--max-memory",
          "must be from 1 to {:g} bytes, not {}", kGreatestBytes, text);
  limit.bytes = static_cast<std::uint64_t>(bytes);
  return limit;
}

FileAccess make_file_access(const FileAccess::Limits& limits) {
  try {
    return FileAccess::within(limits);
  } catch (const AccessError& error) {
    throw RequestError(error.what());
  }
}

}  // namespace lamina::cli
