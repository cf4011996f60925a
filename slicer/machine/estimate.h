#pragma once
// How long a print takes and what it uses up.

#include <optional>
#include <string>

#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

// Exposures [s]. As PrusaSlicer 2.5 counts them, the first layers have one of
// their own and those behind them go over to the usual one in even steps.
struct Exposure {
  double layer = 8;  // what is usual
  double first = 35;

  // Returns the exposure of layer `index`, from 0.
  double of(std::size_t index) const;
};
inline constexpr std::size_t kFirstLayers = 3;
inline constexpr std::size_t kFadeLayers = 10;

// The time of a print [s]; 0 where the printer's moves are not known.
double print_seconds(const Printer& printer, const Exposure& exposure,
                     std::size_t layers);

// That of the material, else what is usual.
Exposure exposure_of(const std::optional<Material>& material);

struct PrintEstimate {
  double seconds = 0;  // 0: not known
  double volume = 0;   // of the part [mm³]
  double grams = 0;    // 0: no material was named
  double price = 0;    // 0: not known
};

// layers  of the part
// volume  [mm³]
PrintEstimate estimate_print(const std::optional<Printer>& printer,
                             const std::optional<Material>& material,
                             std::size_t layers, double volume);

// "0.256 ml of Prusa Orange Tough, 0.28 g, 1 h 12 min on Elegoo Mars 3": what
// is known of it; empty where nothing is.
std::string estimate_text(const std::optional<Printer>& printer,
                          const std::optional<Material>& material,
                          const PrintEstimate& estimate);

}  // namespace lamina::slicer
