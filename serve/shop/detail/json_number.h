#pragma once
// Numbers as JSON, in one notation.

#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

namespace lamina::shop::detail {

// A finite number: whole ones have no point, and 0 no sign.
template <typename Json>
Json json_number(double number) {
  constexpr double kLeastInexact = 9007199254740992;  // 2^53
  const bool is_whole =
      std::trunc(number) == number && std::abs(number) < kLeastInexact;
  return is_whole ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

}  // namespace lamina::shop::detail
