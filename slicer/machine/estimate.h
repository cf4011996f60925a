#pragma once
// How long a print takes and what it uses up.

#include <optional>
#include <string>

#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

// What a part is made with.
struct Machine {
  std::optional<Printer> printer;
  std::optional<Material> material;  // resin or wax, which is printed
  std::optional<Material> metal;     // which is cast from it
};

// The time of a print [s]; 0 where the printer's moves are not known.
double print_seconds(const Printer& printer, const Exposure& exposure,
                     std::size_t layers);

struct ChosenExposure {
  Exposure exposure;
  // What the exposure is for instead, "prusa-sl1" or "layers of 0.1 mm"; empty
  // where it is known for the machine, or where no resin's is known.
  std::string holds_for;
  // Whether nobody found it for this resin, printer and thickness.
  bool is_assumed = true;
};

// That of the resin for the printer and the thickness [mm]; else one that it
// has for others, the nearest thickness first; else what is usual.
ChosenExposure choose_exposure(const Machine& machine, double layer_thickness);

// 0: not known.
struct PrintEstimate {
  double seconds = 0;
  ChosenExposure exposure;  // that the time rests on
  double volume = 0;        // of all that is printed [mm³]
  double grams = 0;         // of resin or wax
  double price = 0;
  double metal_grams = 0;
  double metal_price = 0;

  // The piece as it is in the end.
  double weight() const { return metal_grams > 0 ? metal_grams : grams; }
};

// layers  of the part, all as thick as this [mm]
// volume  of all that is printed [mm³]
// cast    what of that is cast in metal, all but supports [mm³]
PrintEstimate estimate_print(const Machine& machine, double layer_thickness,
                             std::size_t layers, double volume, double cast);

// The sum of what several prints take.
PrintEstimate operator+(PrintEstimate sum, const PrintEstimate& other);

// ", 0.15 EUR"; empty where the price is not known.
std::string price_text(const Material& material, double price);

// "0.256 ml of BlueCast X10, 0.28 g, cast in 3.9 g of yellow gold 750, 1 h
// 12 min on Elegoo Mars 3 if a layer is exposed for 6 s": what is known of it;
// empty where nothing is.
std::string estimate_text(const Machine& machine,
                          const PrintEstimate& estimate);

}  // namespace lamina::slicer
