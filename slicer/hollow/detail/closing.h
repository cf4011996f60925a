#pragma once
// Cavities whose narrow places stay solid.

#include <span>
#include <vector>

#include "slicer/contour/layer.h"

namespace lamina::slicer::detail {

// All places of the layers that are no farther than `radius` from a place of
// the cores [mm], in each layer. With cores that are farther than wall and
// radius from the surface these are the cavities that a ball of the radius can
// reach: an opening of what the wall leaves (Serra 1982).
//
// The ball is sampled at some of the layers that it meets, from inside, so that
// no cavity comes nearer to the surface than the wall.
//
// cores   layers; each section is one of those of `layers`
// layers  of the part, ascending
std::vector<Layer> dilate(std::span<const Layer> cores,
                          std::span<const Layer> layers, double radius);

}  // namespace lamina::slicer::detail
