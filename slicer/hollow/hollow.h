#pragma once
// Hollow parts (`--hollow`): walls of a thickness, cavities that drain, plugs.
//
// The solid hollowed is the solid within the shell of its surface
// (csg/minkowski/shell.h): a change of the program, so its walls are as exact
// as the design's own. What is left out are cavities. A resin printer fills
// them with resin, which must get out, so each gets two drains, a low one and a
// high one that lets air in. One that no drain fits into stays solid.

#include <cstddef>
#include <optional>
#include <vector>

#include "base/diagnostic.h"
#include "csg/scene.h"
#include "slicer/slice/settings.h"

namespace lamina::slicer {

// A round hole through the wall, from inside a cavity to outside.
struct Drain {
  Vec3 from = Vec3(0);
  Vec3 to = Vec3(0);
  double diameter = 0;  // [mm]
};

// Where the user wants a drain: on the surface, or near it.
struct DrainPlace {
  Vec3 place = Vec3(0);
  double diameter = 0;  // [mm]
};

struct HollowSizes {
  double wall = 0;  // least thickness [mm]
  // Not 0: what of a cavity no ball of this radius reaches stays solid [mm].
  // Cavities are then stacks of prisms, one for each layer.
  double closing = 0;
  // Not empty: drains are at these places only, and cavities without one stay
  // solid.
  std::vector<DrainPlace> drains = {};
  bool has_drains = true;     // false: cavities stay closed
  double drain_diameter = 0;  // of the others [mm]; 0: by the size of the part
  // What is drilled stands beside the part, for gluing it in again.
  bool has_plugs = false;

  // With lengths multiplied by a factor. Places of drains stay: they are those
  // of the design.
  HollowSizes scaled(double factor) const;
};

// Drains of parts up to this size [mm] are as narrow as jewelry wants them.
inline constexpr double kSmallPart = 40;
inline constexpr double kSmallDrain = 1.2;
inline constexpr double kLargeDrain = 2;

// How much narrower than its drain a plug is [mm].
inline constexpr double kPlugPlay = 0.1;
// How far from the part and from each other plugs stand [mm].
inline constexpr double kPlugDistance = 2;

struct HollowReport {
  std::size_t cavities = 0;
  std::size_t filled = 0;   // that were too narrow, or had no drain
  double saved_volume = 0;  // of cavities and drains less plugs [mm³]
  double solid_volume = 0;  // of the part before [mm³]
  std::vector<Drain> drains;
};

// Hollows a scene, but for its supports. Slices it twice to find the cavities.
// Warns where nothing is left out, and of drains that reach no cavity.
//
// settings  of the layers in which cavities are looked for
HollowReport hollow_out(csg::Scene& scene, const HollowSizes& sizes,
                        const Settings& settings, Diagnostics& diagnostics);

}  // namespace lamina::slicer
