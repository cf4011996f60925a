#pragma once
// The Boolean program evaluated in a plane.

#include <cstdint>
#include <optional>
#include <vector>

#include "csg/scene.h"
#include "plane/program/program_state.h"
#include "plane/region/region.h"

namespace lamina::csg {

// A leaf that is neither wholly inside nor wholly outside.
struct LiveInstance {
  std::uint32_t instance = 0;
  plane::Region section;  // in the window
};

// Returns where in the window the program holds, given the sections of the
// leaves that divide it; `state` has those of the others that contain all of
// it, and none of the live ones. No value: everywhere. Only operators above
// live instances are looked at.
//
// throws  LimitExceeded for coordinates beyond kGreatestCoordinate
std::optional<plane::Region> evaluate_in_window(
    const Scene& scene, const plane::ProgramState& state,
    const std::vector<LiveInstance>& live, const plane::Region& window);

}  // namespace lamina::csg
