#include "base/number.h"

#include <cmath>

#include <double-conversion/double-conversion.h>

namespace lamina {

std::optional<double> parse_number(std::string_view text) {
  const double_conversion::StringToDoubleConverter converter(
      double_conversion::StringToDoubleConverter::NO_FLAGS, NAN, NAN, nullptr,
      nullptr);
  int used = 0;
  const double value = converter.StringToDouble(
      text.data(), static_cast<int>(text.size()), &used);
  if (text.empty() || used != static_cast<int>(text.size()) ||
      !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace lamina
