#pragma once
// Scenes that are hard on a Boolean: many leaves of all kinds, faces that
// coincide exactly or up to rounding, walls that are almost vertical, slivers,
// copies, mirrors, and a random program over all of it.

#include <cstdint>

#include "csg/scene.h"

namespace lamina::support {

enum class SceneStyle : std::uint8_t {
  kGeneric,    // turned and scaled at random: nothing coincides
  kAligned,    // boxes and prisms on a coarse grid: coincident faces abound
  kNoisy,      // as kAligned, each leaf turned there and back: rounding noise
  kSkewed,     // as kAligned, tilted by 1e-8 to 1e-3: almost vertical walls
  kDuplicate,  // as kGeneric, with copies, some moved by less than a tie
  kMixed,      // each leaf of another style
};
constexpr int kSceneStyleCount = 6;

// Same seed, same scene. Leaves stay within about 8 mm of the origin.
csg::Scene random_scene(std::uint64_t seed, SceneStyle style, int leaf_count);

// The scene as a whole in another place.
csg::Scene placed_scene(csg::Scene scene, const Affine& placement);

}  // namespace lamina::support
