#include "slicer/contour/layer_solids.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plane/loop_area.h"
#include "plane/predicates.h"

namespace lamina::slicer {

LayerSolids::LayerSolids(std::span<const Layer> layers) : layers_(layers) {
  solids_.reserve(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const plane::Contours& contours = layers[i].contours;
    if (i == 0 || contours != layers[i - 1].contours) {
      Solid& solid = solids_.emplace_back();
      solid.edges = plane::EdgeTree(contours);
      solid.box = box_of(contours.points);
    }
    solid_of_.push_back(solids_.size() - 1);
  }
}

double LayerSolids::depth(std::size_t i, Vec2 place) const {
  const plane::EdgeTree& edges = solid(i).edges;
  double distance = std::numeric_limits<double>::infinity();
  if (edges.is_empty()) return -distance;
  std::size_t edge = 0;
  edges.lower(place, 0, distance, edge);
  return edges.winding_number(place) > 0 ? distance : -distance;
}

bool LayerSolids::touches(std::size_t i, Vec2 place) const {
  constexpr double kTouch = 0.02;  // [mm]
  return depth(i, place) > -kTouch || (i > 0 && depth(i - 1, place) > -kTouch);
}

bool LayerSolids::is_free(std::size_t i, Vec2 place, double distance) const {
  const Solid& asked = solid(i);
  if (asked.edges.is_empty()) return true;
  const Box2& box = asked.box;
  if (place.x < box.low.x - distance || place.x > box.high.x + distance ||
      place.y < box.low.y - distance || place.y > box.high.y + distance) {
    return true;
  }
  double nearest = distance;
  std::size_t edge = 0;
  // Any edge that is nearer will do.
  asked.edges.lower(place, std::nextafter(distance, 0), nearest, edge);
  return nearest >= distance && asked.edges.winding_number(place) == 0;
}

Vec2 LayerSolids::nearest(std::size_t i, Vec2 place) const {
  const plane::EdgeTree& edges = solid(i).edges;
  double distance = std::numeric_limits<double>::infinity();
  std::size_t edge = 0;
  edges.lower(place, 0, distance, edge);
  const Vec2 from = edges.from(edge);
  const Vec2 to = edges.to(edge);
  return from + (to - from) * nearest_share(place, from, to);
}

std::size_t LayerSolids::layer_above(double height) const {
  const auto found = std::ranges::upper_bound(layers_, height, {}, &Layer::top);
  return static_cast<std::size_t>(found - layers_.begin());
}

}  // namespace lamina::slicer
