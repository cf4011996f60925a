#pragma once
// Names of colors: those of CSS Color Module Level 4, the 949 of the survey of
// xkcd.com (https://xkcd.com/color/rgb.txt, public domain) behind "xkcd:"
// (newer than 2021.01), and hexadecimal forms.

#include <array>
#include <optional>
#include <string_view>

namespace lamina::csg {

// A line for each name (colors.txt): "xkcd:acid green 8FFE09".
extern const std::string_view kColorTable;

// Red, green, blue, alpha in 0…1, in OpenSCAD's single precision. `name` in
// lower case, or #rgb, #rgba, #rrggbb, #rrggbbaa, or "transparent".
std::optional<std::array<float, 4>> find_color(std::string_view name);

}  // namespace lamina::csg
