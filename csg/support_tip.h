#pragma once
// How thick the tips of supports are, as designs and users say it.

#include <optional>
#include <string_view>

namespace lamina::csg {

// Diameters that a tip may have [mm].
inline constexpr double kLeastSupportTip = 0.1;
inline constexpr double kGreatestSupportTip = 2;

// The diameter of a tip [mm] that is called "light", "medium" or "heavy"; 0 for
// "none". No value for other names.
std::optional<double> support_tip_named(std::string_view name);

}  // namespace lamina::csg
