#pragma once
// What a part is made of: a resin with its exposure, or the metal that is cast
// from it.

#include <string>
#include <vector>

#include "base/file/file_access.h"

namespace lamina::slicer {

// Each text is one line.
struct Material {
  std::string name;
  std::string title;   // as its manufacturer writes it
  std::string source;  // of these figures
  double density = 0;  // [g/cm³]
  // The exposures of a layer and of the first one [s]; 0 where it is not a
  // resin, or where they are not known.
  double exposure = 0;
  double first_exposure = 0;
  std::string printer;         // that these hold for; empty: any
  double layer_thickness = 0;  // that they hold for [mm]; 0: any
  double price = 0;            // of a litre; 0: not known
  std::string currency;

  // [g]
  double weight(double volume_mm3) const { return density * volume_mm3 / 1000; }
};

// The materials that lamina knows, in alphabetical order of their names.
std::vector<Material> known_materials();

// As find_printer().
Material find_material(const std::string& name_or_file,
                       const FileAccess& access = kAllFiles);

}  // namespace lamina::slicer
