#pragma once
// What a camera sees of a stack of layers, drawn by OpenGL as plates.

#include <vector>

#include "ldni/gl/point_raster.h"
#include "slicer/contour/layer.h"
#include "slicer/picture/camera.h"

namespace lamina::slicer {

// A layer between its sides. Of layers that have none they lie halfway to their
// neighbours.
struct Plate {
  double bottom = 0;
  double top = 0;
  double section_z = 0;
};

std::vector<Plate> plates_of(const std::vector<Layer>& layers);

// Of all plates that are not empty.
Box3 bounds_of(const std::vector<Layer>& layers,
               const std::vector<Plate>& plates);

// For each pixel, y down: the place, counted from `origin` so that 32 bits are
// enough, and the number of its layer.
//
// Throws FileError where there is no OSMesa.
std::vector<ldni::TaggedPoint> find_stack_points(
    const std::vector<Layer>& layers, const std::vector<Plate>& plates,
    const Camera& camera, Vec3 origin, unsigned width, unsigned height);

}  // namespace lamina::slicer
