#pragma once
// Units of lengths as AMF and 3MF name them.

#include <string_view>

namespace lamina {

inline constexpr double kMillimetresPerInch = 25.4;

// The length of a unit [mm], of a millimetre without a name; 0 where there is
// none of that name.
inline double length_of_unit(std::string_view name) {
  if (name.empty() || name == "millimeter") return 1;
  if (name == "micron") return 0.001;
  if (name == "centimeter") return 10;
  if (name == "inch") return kMillimetresPerInch;
  if (name == "foot") return 12 * kMillimetresPerInch;
  if (name == "meter") return 1000;
  return 0;
}

}  // namespace lamina
