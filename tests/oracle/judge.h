#pragma once
// Judges one layer against an exact section.

#include <string>

#include "plane/contours.h"
#include "tests/oracle/exact_region.h"

namespace lamina::oracle {

// What a judge allows.
struct Allowance {
  // Area of the symmetric difference for each millimetre of perimeter [mm].
  double distance = 0;
  // Coordinates of a turned design are rounded, so faces that coincide in it
  // are 1e-15 mm apart, and whether a section has a slit there is chance. Where
  // counts differ they are taken again without gaps of twice this width and
  // walls of six times [mm].
  double settle_distance = 0;
};

// Against exact sections: twice the distance at which samples tie (1e-6 mm),
// and counts settled by 20 nm.
constexpr Allowance kExactAllowance = {2e-6, 2e-8};

struct Verdict {
  Comparison comparison;
  RegionCounts counts;       // expected, settled where that was needed
  bool was_settled = false;  // counts agree only after settling
  std::string complaint;     // empty: passed
};

Verdict judge(const ExactRegion& expected, const plane::Contours& actual,
              const Allowance& allowance);
Verdict judge(const ExactRegion& expected, const ExactRegion& actual,
              const Allowance& allowance);

}  // namespace lamina::oracle
