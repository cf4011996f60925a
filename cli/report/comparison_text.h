#pragma once
// What `lamina compare` prints: a table of layers, totals, a verdict; the same
// as JSON.

#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/check/compare/compare.h"

namespace lamina::cli {

// One of the two.
struct SideText {
  std::string name;
  std::string description;  // "SLC 2.0 by lamina 0.1.0"
  double precision = 0;     // [mm]
  bool is_assumed = false;  // the precision
};

struct ComparisonResult {
  SideText a;
  SideText b;
  std::vector<slicer::LayerDifference> layers;
  slicer::ComparisonTotals totals;
  double tolerance = 0;  // [mm]
  Vec3 shift = Vec3(0);  // of b, by --align [mm]
  // Other than 0: this shift would bring all layers within the tolerance.
  Vec3 hint = Vec3(0);

  bool is_equal() const { return totals.outside == 0; }
};

// Ended by '\n'. With lists_all a row for each layer, else those that differ
// most.
std::string comparison_text(const ComparisonResult& result, bool lists_all);

std::string comparison_json(const ComparisonResult& result);

}  // namespace lamina::cli
