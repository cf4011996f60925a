#include "slicer/contour/layer_measures.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "plane/loop_area.h"
#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

struct Outer {
  std::span<const Vec2> loop;
  Box2 box;
  double whole = 0;  // area [mm²], holes included
  double area = 0;   // the same without the holes
};

Outer measure(std::span<const Vec2> loop, double area) {
  Outer outer;
  outer.loop = loop;
  outer.whole = outer.area = area;
  outer.box.add(loop);
  return outer;
}

// The innermost outer loop around a hole that begins at `place`; null if there
// is none.
Outer* find_around(std::vector<Outer>& outers, Vec2 place) {
  std::vector<Outer*> candidates;
  for (Outer& outer : outers) {
    if (outer.box.holds({place, place})) candidates.push_back(&outer);
  }
  // Most holes lie in one box only.
  if (candidates.size() == 1) return candidates.front();
  Outer* innermost = nullptr;
  for (Outer* outer : candidates) {
    if ((innermost == nullptr || outer->whole < innermost->whole) &&
        winding_number(outer->loop, place) != 0) {
      innermost = outer;
    }
  }
  return innermost;
}

}  // namespace

LayerMeasures measure(const plane::Contours& contours) {
  LayerMeasures measures;
  measures.loops = contours.loop_count();
  measures.vertices = contours.points.size();
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const double area = signed_area(contours.loop(i));
    measures.holes += area < 0 ? 1 : 0;
    measures.area += area;
    // Holes lie inside.
    if (area > 0) measures.box.add(contours.loop(i));
  }
  return measures;
}

double volume_of(std::span<const Layer> layers) {
  double volume = 0;
  for (const Layer& layer : layers) {
    volume += measure(layer.contours).area * (layer.top - layer.bottom);
  }
  return volume;
}

double total_perimeter(const plane::Contours& contours) {
  double length = 0;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    length += perimeter(contours.loop(i));
  }
  return length;
}

std::vector<double> areas_of_regions(const plane::Contours& contours) {
  std::vector<Outer> outers;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const double area = signed_area(contours.loop(i));
    if (area > 0) outers.push_back(measure(contours.loop(i), area));
  }
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const double area = signed_area(contours.loop(i));
    if (area >= 0) continue;
    Outer* const outer = find_around(outers, contours.loop(i).front());
    if (outer != nullptr) outer->area += area;
  }
  std::vector<double> areas(outers.size());
  std::ranges::transform(outers, areas.begin(), &Outer::area);
  return areas;
}

}  // namespace lamina::slicer
