#include "slicer/formats/detail/reading.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "plane/loop_area.h"

namespace lamina::slicer {

void fail_to_read(const std::string& path, std::string_view message) {
  throw FileError(fmt::format("{}: {}", path, message));
}

void fail_to_open(const std::string& path) {
  throw FileError(fmt::format("Can't open input file '{}': {}", path,
                              words_of_open_fault(errno)));
}

std::string read_whole(const std::string& path, const FileAccess& access) {
  access.require(path);
  std::optional<std::string> bytes = access.read_regular(path);
  if (!bytes) fail_to_open(path);
  return std::move(*bytes);
}

std::size_t line_at(std::string_view text, std::size_t place) {
  const std::string_view before = text.substr(0, place);
  return 1 + static_cast<std::size_t>(
                 std::count(before.begin(), before.end(), '\n'));
}

void skip(std::string_view& text, std::string_view characters) {
  text.remove_prefix(std::min(text.find_first_not_of(characters), text.size()));
}

bool take_number(std::string_view& text, double& value) {
  skip(text, " \t\r\n");
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [rest, fault] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || !std::isfinite(value)) return false;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return true;
}

void add_loop(std::span<const Vec2> points, LoopKind kind, std::size_t layer,
              plane::Contours& contours, LayerFileFacts& facts) {
  if (points.size() > 1 && points.front() == points.back()) {
    points = points.first(points.size() - 1);
  }
  if (points.size() < 3) {
    facts.short_loops.add(layer, points);
    return;
  }
  const bool is_clockwise = signed_area(points) < 0;
  auto& all = contours.points;
  if (is_clockwise == (kind == LoopKind::kHole)) {
    all.insert(all.end(), points.begin(), points.end());
  } else {
    all.insert(all.end(), points.rbegin(), points.rend());
  }
  contours.ends.push_back(static_cast<std::uint32_t>(all.size()));
}

}  // namespace lamina::slicer
