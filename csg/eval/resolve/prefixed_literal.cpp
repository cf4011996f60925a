#include "csg/eval/resolve/prefixed_literal.h"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>

namespace lamina::csg {

namespace {

constexpr std::size_t kPrefix = 2;

struct Radix {
  int base = 0;
  std::string_view digits;
  std::string_view name;
};
constexpr Radix kHexadecimal = {16, "0123456789abcdefABCDEF", "Hexadecimal"};
constexpr Radix kBinary = {2, "01", "Binary"};

const Radix* radix_of(std::string_view name) {
  if (name.starts_with("0x")) return &kHexadecimal;
  return name.starts_with("0b") ? &kBinary : nullptr;
}

}  // namespace

bool is_prefixed_literal(std::string_view name) {
  const Radix* radix = radix_of(name);
  return radix != nullptr && name.size() > kPrefix &&
         name.find_first_not_of(radix->digits, kPrefix) ==
             std::string_view::npos;
}

PrefixedLiteral read_prefixed_literal(std::string_view name) {
  const Radix& radix = *radix_of(name);
  std::uint64_t digits = 0;
  const auto read = std::from_chars(
      name.data() + kPrefix, name.data() + name.size(), digits, radix.base);
  if (read.ec != std::errc()) {
    return {0x1p64,
            fmt::format("{} constant \"{}\" too large", radix.name, name)};
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
