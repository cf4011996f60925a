#pragma once
// What the program asks of the module that is linked with OpenMesh.

#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// Changes with everything that is declared here.
constexpr int kDecimationVersion = 1;

enum class DecimationOutcome : std::uint8_t {
  kDone,
  kOtherVersion,
  kNoMemory,
  kNoManifold  // a promise was broken
};

// Decimates a manifold with boundary: replaces its triangles, and leaves its
// vertices, used or not.
//
// is_fixed   of each vertex; the boundary is fixed in any case
// tolerance  [mm]
using DecimateManifold = DecimationOutcome(int version, Mesh& mesh,
                                           const std::vector<bool>& is_fixed,
                                           double tolerance);

}  // namespace lamina::csg
