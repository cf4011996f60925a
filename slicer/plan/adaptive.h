#pragma once
// Layers as thick as the surface allows (`--adaptive`).
//
// Between the corners of two steps and a slanting surface there is, measured
// along its normal n,
//   cusp = t · |n_z|                          (t: thickness of the layer)
// after Dolenc and Mäkelä, Slicing procedures for layered manufacturing
// techniques, CAD 26 (1994). They take the normal of the surface where it
// passes the layer's lower side; here every facet that comes into the layer
// counts, so that the bound holds in all of it: t = cusp / |n_z| for the most
// demanding one. Since sections stand in the middle of layers, the surface is
// never farther than half a cusp from the steps.
//
// A ply is as high as the thinnest layer. The boundary faces that come into a
// ply limit the layers with it, and layers are stacked from plies
// (detail/stacking.h). Flat faces, peaks and pits make no steps: where one lies
// on a border of plies a layer ends there, else its ply is a layer of its own.

#include <cstddef>
#include <limits>

#include "csg/scene.h"
#include "ldni/section/grid.h"

namespace lamina::slicer {

// How thick layers may be [mm].
struct AdaptiveThickness {
  double thinnest = 0;  // layers are multiples of it
  double thickest = 0;  // 0: four times the thinnest
  double cusp = 0;      // greatest distance of a step's corner from the surface
  // Runs of layers of equal thickness, at most (detail/stacking.h).
  std::size_t most_runs = std::numeric_limits<std::size_t>::max();
};

// Returns layers for a cusp. In each of them t · |n_z| <= cusp for every facet
// of the surface that comes into it by more than kTieDistance, or it is as thin
// as layers can be. Throws GeometryError where there are too many plies to plan
// with.
ldni::LayerGrid adaptive_grid(const csg::Scene& scene,
                              const AdaptiveThickness& thickness);

}  // namespace lamina::slicer
