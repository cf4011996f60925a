#pragma once
// Counts and measures of one layer.
//
// Every layer of a job is counted, so perimeters, whose roots would cost a job
// some percent of its time, are for those who ask.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

struct LayerMeasures {
  std::size_t loops = 0;
  std::size_t holes = 0;
  std::size_t vertices = 0;
  double area = 0;  // holes count negative [mm²]
  Box2 box;
};

LayerMeasures measure(const plane::Contours& contours);

// Of layers as high as they are [mm³].
double volume_of(std::span<const Layer> layers);

// The length of all loops [mm].
double total_perimeter(const plane::Contours& contours);

// The areas of the regions, each an outer loop less its holes [mm²], in the
// order of the outer loops.
//
// contours  disjoint loops, outer ones counter-clockwise, holes clockwise
std::vector<double> areas_of_regions(const plane::Contours& contours);

}  // namespace lamina::slicer
