#include "compiler/tasks/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slicer/contour/deviation.h"

namespace lamina::compiler {
namespace {

using slicer::Layer;
using slicer::LayerDifference;
using slicer::LayerPair;

// Smaller distances mean nothing to a printer. And where a surface is nearly
// level, contours move by far more than heights are rounded by [mm].
constexpr double kLeastTolerance = 0.001;

// How far beside a face a section is cut again: twice the distance at which
// lamina takes two heights for one, or twice what rounded numbers can be off by
// there, in a mesh and in a file [mm].
double distance_beside_face(double z) {
  return std::max(2e-6, 4 * slicer::float32_rounding(std::abs(z)));
}

double thickness(const Layer& layer) { return layer.top - layer.bottom; }

// Whether the layers reach as far as their thicknesses say. Of sections at any
// heights, thicknesses are only a guess.
bool tells_reach(Compared& side) {
  const std::vector<Layer>& layers = side.layers();
  if (layers.empty() || !(thickness(layers.front()) > 0)) return false;
  if (side.has_sides()) return true;
  const auto like_first = [&](const Layer& layer) {
    return std::abs(thickness(layer) - thickness(layers.front())) <
           slicer::kSameHeight;
  };
  return std::all_of(layers.begin(), layers.end(), like_first);
}

bool is_good(const LayerDifference& layer, double tolerance) {
  return layer.distance.distance <= tolerance;
}

}  // namespace

Comparison::Comparison(Compared& a, Compared& b, bool aligns) : a_(a), b_(b) {
  if (aligns) {
    shift_ = find_shift();
  } else {
    pair_at(0);
  }
}

// The heights at which the other side is cut.
std::vector<double> Comparison::heights_of(Compared& side, double shift) const {
  const std::vector<Layer>& layers = side.layers();
  slicer::require_rising(layers, side.name());
  std::vector<double> heights;
  const bool has_reach = tells_reach(side);
  if (has_reach) {
    const Layer& first = layers.front();
    heights.push_back(first.section_z - thickness(first) + shift);
  }
  for (const Layer& layer : layers) {
    heights.push_back(layer.section_z + shift);
  }
  if (has_reach) {
    const Layer& last = layers.back();
    heights.push_back(last.section_z + thickness(last) + shift);
  }
  return heights;
}

// Cuts, and pairs layers, with b's heights raised by `rise`.
void Comparison::pair_at(double rise) {
  if (b_.can_be_cut()) {
    cut_ = b_.cut(heights_of(a_, -rise));
    layers_a_ = &a_.layers();
    layers_b_ = &cut_;
  } else if (a_.can_be_cut()) {
    cut_ = a_.cut(heights_of(b_, rise));
    layers_a_ = &cut_;
    layers_b_ = &b_.layers();
  } else {
    layers_a_ = &a_.layers();
    layers_b_ = &b_.layers();
  }
  pairs_ =
      slicer::pair_layers(*layers_a_, *layers_b_, rise, a_.name(), b_.name());
}

// Leaves the layers paired as the shift moves them.
Vec3 Comparison::find_shift() {
  const double rise = slicer::aligning_shift(a_.layers(), b_.layers()).z;
  pair_at(rise);
  const Vec3 shift = slicer::aligning_shift(*layers_a_, *layers_b_);
  return {shift.x, shift.y, rise};
}

double Comparison::usual_tolerance() const {
  return std::max(kLeastTolerance, a_.text().precision + b_.text().precision);
}

ComparisonResult Comparison::run(double tolerance) {
  ComparisonResult result;
  result.tolerance = tolerance;
  result.shift = shift_;
  result.layers = slicer::compare(pairs_, Vec2(shift_.x, shift_.y));
  if (layers_a_ == &cut_ || layers_b_ == &cut_) {
    move_off_faces(result);
    drop_empty(result);
  }
  result.totals = slicer::sum_up(result.layers, tolerance);
  result.a = a_.text();
  result.b = b_.text();
  return result;
}

// Replaces layers that differ by sections just below or above, where those are
// within the tolerance.
void Comparison::move_off_faces(ComparisonResult& result) {
  const bool is_b_cut = layers_b_ == &cut_;
  const double shift = is_b_cut ? -shift_.z : shift_.z;
  std::vector<std::size_t> rows;
  std::vector<double> heights;
  std::vector<double> moves;
  for (std::size_t row = 0; row < result.layers.size(); ++row) {
    if (is_good(result.layers[row], result.tolerance)) continue;
    const LayerPair& pair = pairs_[row];
    const Layer* const given = is_b_cut ? pair.a : pair.b;
    const double z = given != nullptr ? given->section_z + shift
                                      : (is_b_cut ? pair.b : pair.a)->section_z;
    const double move = distance_beside_face(z);
    for (const double rise : {-move, move}) {
      rows.push_back(row);
      heights.push_back(z + rise);
      moves.push_back(rise);
    }
  }
  std::vector<Layer> layers = (is_b_cut ? b_ : a_).cut(heights);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    LayerPair pair = pairs_[rows[i]];
    (is_b_cut ? pair.b : pair.a) = &layers[i];
    LayerDifference difference =
        slicer::compare_pair(pair, Vec2(shift_.x, shift_.y));
    LayerDifference& shown = result.layers[rows[i]];
    if (!is_good(difference, result.tolerance) ||
        is_good(shown, result.tolerance)) {
      continue;
    }
    difference.number = shown.number;
    difference.z = shown.z;
    difference.moved = moves[i];
    difference.thickness = shown.thickness;
    shown = difference;
    cut_beside_faces_.push_back(std::move(layers[i]));
    (is_b_cut ? pairs_[rows[i]].b : pairs_[rows[i]].a) =
        &cut_beside_faces_.back();
  }
}

// Beside a face, a section above or below the other one's layers can be empty.
void Comparison::drop_empty(ComparisonResult& result) {
  std::size_t kept = 0;
  for (std::size_t row = 0; row < pairs_.size(); ++row) {
    const LayerDifference& layer = result.layers[row];
    const bool is_alone = pairs_[row].a == nullptr || pairs_[row].b == nullptr;
    if (is_alone && layer.area() == 0) continue;
    pairs_[kept] = pairs_[row];
    result.layers[kept] = layer;
    result.layers[kept].number = kept + 1;
    ++kept;
  }
  pairs_.resize(kept);
  result.layers.resize(kept);
}

Layer Comparison::layer_a(std::size_t index) const {
  const Layer* const layer = pairs_.at(index).a;
  return layer != nullptr ? *layer : Layer();
}

Layer Comparison::layer_b(std::size_t index) const {
  const Layer* const layer = pairs_.at(index).b;
  Layer moved = layer != nullptr ? *layer : Layer();
  for (Vec2& point : moved.contours.points) {
    point += Vec2(shift_.x, shift_.y);
  }
  return moved;
}

}  // namespace lamina::compiler
