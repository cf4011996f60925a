#pragma once
// Cavities of a hollow part: the solids of a stack of layers that hang
// together.

#include <cstddef>
#include <span>
#include <vector>

#include "plane/region/region.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer::detail {

struct CavityLayer {
  std::size_t layer = 0;  // index into the stack
  plane::Region region;   // of the cavity in that layer
};

struct Cavity {
  std::vector<CavityLayer> layers;  // ascending; may branch
  double volume = 0;                // [mm³]
};

// layers  of what is left out of the part, ascending
std::vector<Cavity> find_cavities(std::span<const Layer> layers);

// Whether a circle of this diameter fits into a layer of it [mm].
bool has_room(const Cavity& cavity, double diameter);

}  // namespace lamina::slicer::detail
