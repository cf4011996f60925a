#pragma once
// What a slicing job is asked for, from the command line or a library's user.

#include <cstdint>
#include <vector>

#include "ldni/ray_grid.h"

namespace lamina::slicer {

enum class ContourMode { kFaithful, kPaper };
using BoxMode = ldni::BoxMode;
// How the paper's contours get their samples: exactly, or drawn by OpenGL, by a
// list of fragments or by the paper's depth peeling.
enum class SamplerKind { kScanline, kGl, kGlPeeling };

// Layers by number, from 1 as `lamina inspect` counts them; both ends belong to
// it.
struct LayerRange {
  std::uint32_t first = 1;
  std::uint32_t last = 0xffffffff;

  bool contains(std::uint32_t layer) const {
    return first <= layer && layer <= last;
  }
};

struct Settings {
  double layer_thickness = 0.05;  // [mm]
  // Not 0: layers of several thicknesses, multiples of layer_thickness, so that
  // steps on the surface are no larger than this [mm] (adaptive.h).
  double cusp = 0;
  double greatest_thickness = 0;  // of these [mm]; 0: 4 · layer_thickness
  std::vector<double> heights;    // not empty: sections at exactly these
  LayerRange written;             // of the layers that there are
  double ray_pitch = 0;           // [mm]; 0 = auto
  double tolerance = 0.001;       // [mm]; 0 writes all vertices
  double compensation = 0;        // [mm] inwards; negative: outwards
  // Walls and gaps thinner than this are looked for, in faithful contours only
  // [mm]; 0: they are not.
  double min_feature = 0;
  ContourMode contour = ContourMode::kFaithful;
  BoxMode boxes = BoxMode::kLocal;               // of the paper's samplers
  SamplerKind sampler = SamplerKind::kScanline;  // of the paper's contours
  unsigned threads = 0;  // 0: as many as the machine has
};

}  // namespace lamina::slicer
