#pragma once
// What a part is made of: the resin or wax that is printed, with its exposures,
// and the metal that is cast from it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"
#include "slicer/contour/compensate.h"

namespace lamina::slicer {

// Exposures of the layers of a print [s]. As PrusaSlicer 2.5 counts them, the
// first layers have one of their own and those behind them go over to the usual
// one in even steps.
struct Exposure {
  double layer = 8;  // what is usual
  double first = 35;

  // Returns the exposure of layer `index`, from 0.
  double of(std::size_t index) const;
};
inline constexpr std::size_t kFirstLayers = 3;
inline constexpr std::size_t kFadeLayers = 10;

// An exposure that somebody found for a resin.
struct KnownExposure {
  Exposure exposure;
  std::string printer;         // that it holds for; empty: any
  double layer_thickness = 0;  // that it holds for [mm]; 0: any
  std::string source;
};

// "62.5 EUR/g"
struct Price {
  double amount = 0;
  std::string currency;  // may be empty
  std::string unit;      // of kPriceUnits

  // What so much of the material costs.
  double of(double grams, double volume_mm3) const;
};
// Gram, kilogram, troy ounce, litre.
inline constexpr std::string_view kPriceUnits[] = {"g", "kg", "oz", "l"};

// Reads "62.5 EUR/g"; no value where it is not one.
std::optional<Price> parse_price(std::string_view text);

// What a casting of a metal asks of a design [mm].
struct CastingLimits {
  double wall = 0;       // least thickness of a wall
  double wire = 0;       // least diameter of a prong or a wire
  double gap = 0;        // least width of an engraving or a gap
  double engraving = 0;  // least depth of an engraving; 0: any
  double finishing = 0;  // what filing and polishing take of a surface, at most
  std::string source;
};

// Each text is one line.
struct Material {
  std::string name;
  std::string title;                     // as its manufacturer writes it
  std::vector<std::string> also;         // other names
  std::string source;                    // of these figures
  double density = 0;                    // [g/cm³]
  std::vector<KnownExposure> exposures;  // of a resin, if known
  std::optional<Price> price;
  double support_tip = 0;  // diameter of the tips that hold it [mm]; 0: usual
  std::optional<CastingLimits> casting;  // of a metal, if known
  Compensation compensation;             // that its prints need, if known

  // [g]
  double weight(double volume_mm3) const { return density * volume_mm3 / 1000; }
  // By its density: the lightest that is cast has 2.7 g/cm³, and resins stay
  // below 2 even when they are filled.
  bool is_metal() const { return density > 2.5; }
};

// The materials that lamina knows, in alphabetical order of their names. They
// are read when they are first asked for.
const std::vector<Material>& known_materials();

// As find_printer().
Material find_material(const std::string& name_or_file,
                       const FileAccess& access = kAllFiles);

}  // namespace lamina::slicer
