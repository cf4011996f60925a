#pragma once
// Stones that a design is made for, as far as its customizer names them.
//
// A parameter is about stones where its name or its group has a word for them:
// stone, gem, diamond, brilliant, carat. Its description alone decides only
// where it says diameter or carat too: "metal beside the stones" is not about
// their size. Nothing else is guessed.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "parser/customizer/customizer.h"

namespace lamina::compiler {

struct StoneParameter {
  CustomizerEntry entry;
  // Both, as if the stone were a round brilliant, where it is a number that its
  // name or the first word of its description calls a diameter ("stone_d",
  // "diameter of the stones") or a weight in carat.
  std::optional<double> diameter = {};  // [mm]
  std::optional<double> carats = {};
};

// In the order of the parameters.
std::vector<StoneParameter> find_stones(
    std::span<const CustomizerEntry> parameters);

// The weight [carat] of a round brilliant diamond with a diameter [mm], and the
// reverse: diameter² · depth · 0.0061, with a depth of 0.6 diameters. Source:
// the usual estimate of mounted stones, as the GIA teaches it.
double brilliant_carats(double diameter);
double brilliant_diameter(double carats);

}  // namespace lamina::compiler
