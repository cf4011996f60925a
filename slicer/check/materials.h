#pragma once
// Materials of prints and casts, and their weight.

#include <array>
#include <string_view>

namespace lamina::slicer {

struct Material {
  std::string_view name;
  double density;  // [g/cm³]
};

// Alloys differ from maker to maker by some hundredths; these are usual values
// (docs/usage.md).
inline constexpr std::array<Material, 11> kMaterials = {{
    {"gold 18k yellow", 15.4},
    {"gold 14k yellow", 13.1},
    {"platinum 950", 20.7},
    {"palladium 950", 11.8},
    {"fine silver", 10.49},
    {"sterling silver", 10.36},
    {"bronze", 8.8},
    {"brass", 8.5},
    {"steel 316L", 8.0},
    {"castable resin", 1.1},
    {"casting wax", 0.95},
}};

// The weight of a volume [g].
inline double weight(const Material& material, double volume_mm3) {
  return material.density * volume_mm3 / 1000;
}

}  // namespace lamina::slicer
