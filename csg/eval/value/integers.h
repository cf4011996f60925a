#pragma once
// Numbers cut to integers. What does not fit becomes the least integer, as on
// x86; C++ leaves that undefined.

#include <cmath>
#include <cstdint>
#include <limits>

namespace lamina::csg {

inline int cut_to_int(double number) {
  constexpr double kLimit = 2147483648.0;
  return std::fabs(number) < kLimit ? static_cast<int>(number)
                                    : std::numeric_limits<int>::min();
}

inline std::int64_t cut_to_int64(double number) {
  constexpr double kLimit = 9223372036854775808.0;
  return std::fabs(number) < kLimit ? static_cast<std::int64_t>(number)
                                    : std::numeric_limits<std::int64_t>::min();
}

}  // namespace lamina::csg
