#include "slicer/formats/detail/text_output.h"

namespace lamina {
namespace {

// Sign, four digits, point, seven decimals.
constexpr std::size_t kNumberWidth = 13;

}  // namespace

std::string fixed_width(double value) {
  value += 0.0;  // -0 prints as 0
  for (int decimals = kNumberWidth - 2; decimals > 0; --decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.size() == kNumberWidth) return text;
  }
  return fmt::format("{:.6e}", value).substr(0, kNumberWidth);
}

}  // namespace lamina
