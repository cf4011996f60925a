#pragma once

#include <cstdint>

namespace lamina::ldni {

// What of loops that cross is inside, by the winding number of a point: the
// sum of the turns that the loops make around it, counter-clockwise ones
// counted positive.
enum class FillRule : std::uint8_t { kNonZero, kPositive, kEvenOdd };

constexpr bool is_inside(std::int32_t winding_number, FillRule rule) {
  switch (rule) {
    case FillRule::kNonZero:
      return winding_number != 0;
    case FillRule::kPositive:
      return winding_number > 0;
    case FillRule::kEvenOdd:
      break;
  }
  return winding_number % 2 != 0;
}

}  // namespace lamina::ldni
