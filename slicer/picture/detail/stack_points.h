#pragma once
// What a camera sees of a stack of layers, which OpenGL draws as plates.

#include <vector>

#include "ldni/gl/point_raster.h"
#include "slicer/contour/layer.h"
#include "slicer/picture/camera.h"

namespace lamina::slicer {

// A layer between its sides. Where a layer has no sides, they lie halfway to
// its neighbours.
struct Plate {
  double bottom = 0;
  double top = 0;
  double section_z = 0;
};

std::vector<Plate> plates_of(const std::vector<Layer>& layers);

// The box of all plates that are not empty.
Box3 bounds_of(const std::vector<Layer>& layers,
               const std::vector<Plate>& plates);

// Returns for each pixel, y down, the place that it shows, counted from
// `origin` so that 32 bits are enough, and the number of its layer.
//
// Throws FileError where there is no OSMesa.
std::vector<ldni::TaggedPoint> find_stack_points(
    const std::vector<Layer>& layers, const std::vector<Plate>& plates,
    const Camera& camera, Vec3 origin, unsigned width, unsigned height);

}  // namespace lamina::slicer
