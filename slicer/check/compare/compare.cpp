#include "slicer/check/compare/compare.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "base/diagnostic.h"
#include "base/parallel.h"
#include "plane/loop_area.h"
#include "slicer/contour/layer_measures.h"

namespace lamina::slicer {
namespace {

LoopCount count_loops(const plane::Contours& contours) {
  const LayerMeasures measures = measure(contours);
  return {measures.loops - measures.holes, measures.holes};
}

bool is_sliver(std::span<const Vec2> loop) {
  return 2 * std::abs(signed_area(loop)) <= kSliverWidth * perimeter(loop);
}

plane::Contours without_slivers(const plane::Contours& contours) {
  plane::Contours kept;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    if (!is_sliver(loop)) kept.add_loop(loop);
  }
  return kept;
}

[[noreturn]] void fail(const std::string& words) { throw GeometryError(words); }

// A stack of layers, and how far a walk through both has come.
struct Walk {
  const std::vector<Layer>& layers;
  double shift;
  const std::string& name;
  std::size_t at = 0;

  bool is_over() const { return at == layers.size(); }
  double height(std::size_t i) const { return layers[i].section_z + shift; }
  // The height of the layer in hand; infinite behind the last one.
  double height() const {
    return is_over() ? std::numeric_limits<double>::infinity() : height(at);
  }
  bool reaches_over(double z) const {
    return !layers.empty() && z > height(0) && z < height(layers.size() - 1);
  }
  double height_nearest_to(double z) const {
    const bool is_low =
        at > 0 && (is_over() || z - height(at - 1) < height(at) - z);
    return height(is_low ? at - 1 : at);
  }
};

// Takes a layer of `walk` that has no partner; null where it is empty.
const Layer* take_alone(Walk& walk, const Walk& other) {
  const Layer& layer = walk.layers[walk.at];
  const double z = walk.height();
  ++walk.at;
  if (layer.contours.is_empty()) return nullptr;
  if (other.reaches_over(z)) {
    fail(fmt::format(
        "layers of different heights cannot be compared: {} has one at z "
        "{:.6g}, {} has its nearest at z {:.6g}; cut one of them at the "
        "heights of the other, or compare each with the design",
        walk.name, z, other.name, other.height_nearest_to(z)));
  }
  return &layer;
}

// The least x and y of all contours, and the bottom of the first layer that has
// one; none where no layer has.
std::optional<Vec3> low_corner_of(const std::vector<Layer>& layers) {
  std::optional<Vec3> corner;
  for (const Layer& layer : layers) {
    for (const Vec2& point : layer.contours.points) {
      if (!corner) corner = Vec3(point, layer.bottom);
      corner = Vec3(glm::min(Vec2(*corner), point), corner->z);
    }
  }
  return corner;
}

const plane::Contours& contours_of(const Layer* layer) {
  static const plane::Contours none;
  return layer != nullptr ? layer->contours : none;
}

}  // namespace

LayerDifference compare_pair(const LayerPair& pair, Vec2 shift) {
  assert(pair.a != nullptr || pair.b != nullptr);
  LayerDifference difference;
  if (pair.b != nullptr && shift != Vec2(0)) {
    plane::Contours shifted = pair.b->contours;
    for (Vec2& point : shifted.points) point += shift;
    difference = compare_layers(contours_of(pair.a), shifted);
  } else {
    difference = compare_layers(contours_of(pair.a), contours_of(pair.b));
  }
  difference.z = pair.a != nullptr ? pair.a->section_z : pair.b->section_z;
  for (const Layer* layer : {pair.a, pair.b}) {
    if (layer == nullptr) continue;
    difference.thickness =
        std::max(difference.thickness, layer->top - layer->bottom);
  }
  return difference;
}

void require_rising(const std::vector<Layer>& layers, const std::string& name) {
  for (std::size_t i = 1; i < layers.size(); ++i) {
    if (layers[i].section_z > layers[i - 1].section_z) continue;
    fail(
        fmt::format("{}: layer {} at z {:.6g} is not higher than the one "
                    "before, at z {:.6g}",
                    name, i + 1, layers[i].section_z, layers[i - 1].section_z));
  }
}

LayerDifference compare_layers(const plane::Contours& a,
                               const plane::Contours& b) {
  LayerDifference difference;
  difference.areas = plane::measure_regions(a, b);
  difference.loops_a = count_loops(a);
  difference.loops_b = count_loops(b);
  difference.distance =
      greatest_distance(without_slivers(a), without_slivers(b));
  return difference;
}

std::vector<LayerPair> pair_layers(const std::vector<Layer>& a,
                                   const std::vector<Layer>& b, double shift,
                                   const std::string& name_a,
                                   const std::string& name_b) {
  require_rising(a, name_a);
  require_rising(b, name_b);
  Walk walk_a{a, 0, name_a};
  Walk walk_b{b, shift, name_b};
  std::vector<LayerPair> pairs;
  while (!walk_a.is_over() || !walk_b.is_over()) {
    const double ahead = walk_b.height() - walk_a.height();
    if (std::abs(ahead) <= kSameHeight) {
      pairs.push_back({&a[walk_a.at++], &b[walk_b.at++]});
    } else if (ahead > 0) {
      if (const Layer* layer = take_alone(walk_a, walk_b)) {
        pairs.push_back({layer, nullptr});
      }
    } else if (const Layer* layer = take_alone(walk_b, walk_a)) {
      pairs.push_back({nullptr, layer});
    }
  }
  return pairs;
}

std::vector<LayerDifference> compare(const std::vector<LayerPair>& pairs,
                                     Vec2 shift) {
  std::vector<LayerDifference> differences(pairs.size());
  for_each_index(pairs.size(), [&](std::size_t i) {
    differences[i] = compare_pair(pairs[i], shift);
    differences[i].number = i + 1;
  });
  return differences;
}

Vec3 aligning_shift(const std::vector<Layer>& a, const std::vector<Layer>& b) {
  const std::optional<Vec3> corner_a = low_corner_of(a);
  const std::optional<Vec3> corner_b = low_corner_of(b);
  return corner_a && corner_b ? *corner_a - *corner_b : Vec3(0);
}

ComparisonTotals sum_up(const std::vector<LayerDifference>& layers,
                        double tolerance) {
  ComparisonTotals totals;
  totals.layers = layers.size();
  const auto rank = [&](std::size_t i) {
    return std::tuple(layers[i].distance.distance, layers[i].area());
  };
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const LayerDifference& layer = layers[i];
    totals.outside += layer.distance.distance > tolerance ? 1 : 0;
    totals.other_loops += layer.loops_a == layer.loops_b ? 0 : 1;
    totals.volume_a += layer.areas.a() * layer.thickness;
    totals.volume_b += layer.areas.b() * layer.thickness;
    totals.volume_only_a += layer.areas.only_a * layer.thickness;
    totals.volume_only_b += layer.areas.only_b * layer.thickness;
    if (!totals.worst || rank(i) > rank(*totals.worst)) totals.worst = i;
  }
  return totals;
}

}  // namespace lamina::slicer
