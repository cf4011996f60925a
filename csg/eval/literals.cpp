#include "csg/eval/literals.h"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>

namespace lamina::csg {

bool is_hex_literal(std::string_view name) {
  return name.size() > 2 && name.starts_with("0x") &&
         name.find_first_not_of("0123456789abcdefABCDEF", 2) ==
             std::string_view::npos;
}

HexLiteral read_hex_literal(std::string_view name) {
  std::uint64_t digits = 0;
  const auto read =
      std::from_chars(name.data() + 2, name.data() + name.size(), digits, 16);
  if (read.ec != std::errc()) {
    return {0x1p64, fmt::format("Hexadecimal constant \"{}\" too large", name)};
  }
  const auto value = static_cast<double>(digits);
  // 2^64 would not convert back.
  if (value < 0x1p64 && static_cast<std::uint64_t>(value) == digits) {
    return {value, {}};
  }
  return {value,
          fmt::format("Integer \"{}\" cannot be represented precisely", name)};
}

}  // namespace lamina::csg
