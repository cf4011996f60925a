#pragma once
// Two things brought to the same heights and compared.
//
// Whichever of them can be cut is cut at the sections of the other, and once
// below and once above them: a file that ends too early differs there. Files
// and meshes round heights. So where a section lies in a horizontal face, the
// two can be on different sides of it, which is not a difference of the part:
// layers that differ are cut again just below and just above.

#include <list>
#include <string>
#include <vector>

#include "base/vec.h"
#include "compiler/tasks/compared.h"
#include "slicer/check/compare/compare.h"

namespace lamina::compiler {

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

class Comparison {
 public:
  // Both outlive it. Cuts and pairs layers; throws GeometryError where their
  // heights do not match.
  //
  // aligns  moves b so that the lower left corners of boxes and the lowest
  //         layers agree
  Comparison(Compared& a, Compared& b, bool aligns);

  // The tolerance that follows from what both say of themselves [mm].
  double usual_tolerance() const;

  // tolerance  [mm]
  ComparisonResult run(double tolerance);

  // The layers of a row of the result, by its index; b's is moved as --align
  // asks.
  slicer::Layer layer_a(std::size_t index) const;
  slicer::Layer layer_b(std::size_t index) const;

 private:
  void pair_at(double rise);
  std::vector<double> heights_of(Compared& side, double shift) const;
  void move_off_faces(ComparisonResult& result);
  void drop_empty(ComparisonResult& result);
  Vec3 find_shift();

  Compared& a_;
  Compared& b_;
  Vec3 shift_ = Vec3(0);  // of b
  // At most one of them points to `cut_`.
  const std::vector<slicer::Layer>* layers_a_ = nullptr;
  const std::vector<slicer::Layer>* layers_b_ = nullptr;
  std::vector<slicer::Layer> cut_;
  std::list<slicer::Layer> cut_beside_faces_;
  std::vector<slicer::LayerPair> pairs_;
};

}  // namespace lamina::compiler
