#include "csg/eval/builtin/colors.h"

#include <charconv>
#include <cstdint>
#include <unordered_map>

namespace lamina::csg {

namespace {

using ColorTable = std::unordered_map<std::string_view, std::string_view>;

ColorTable read_table() {
  constexpr std::size_t kDigits = 6;
  ColorTable table;
  for (std::string_view rest = kColorTable; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    table.emplace(rest.substr(0, end - kDigits - 1),
                  rest.substr(end - kDigits, kDigits));
    rest.remove_prefix(end + 1);
  }
  return table;
}

std::optional<std::array<float, 4>> parse_hex(std::string_view digits) {
  const std::size_t count = digits.size();
  if (count != 3 && count != 4 && count != 6 && count != 8) {
    return std::nullopt;
  }
  const std::size_t width = count < 6 ? 1 : 2;
  std::array<float, 4> rgba = {0, 0, 0, 1};
  for (std::size_t i = 0; i < count / width; ++i) {
    std::uint32_t channel = 0;
    const std::string_view part = digits.substr(i * width, width);
    const auto read = std::from_chars(part.begin(), part.end(), channel, 16);
    if (read.ptr != part.end()) return std::nullopt;
    rgba[i] = static_cast<float>(channel) / (width == 1 ? 15.0F : 255.0F);
  }
  return rgba;
}

}  // namespace

std::optional<std::array<float, 4>> find_color(std::string_view name) {
  if (name == "transparent") return std::array<float, 4>{0, 0, 0, 0};
  if (name.starts_with('#')) return parse_hex(name.substr(1));
  static const ColorTable table = read_table();
  const auto found = table.find(name);
  return found == table.end() ? std::nullopt : parse_hex(found->second);
}

}  // namespace lamina::csg
