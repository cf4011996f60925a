#include "csg/support_tip.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lamina::csg {

std::optional<double> support_tip_named(std::string_view name) {
  using Row = std::pair<std::string_view, double>;
  constexpr std::array<Row, 4> kTips = {
      {{"none", 0}, {"light", 0.25}, {"medium", 0.3}, {"heavy", 0.4}}};
  const auto* const found = std::ranges::find(kTips, name, &Row::first);
  if (found == kTips.end()) return std::nullopt;
  return found->second;
}

}  // namespace lamina::csg
