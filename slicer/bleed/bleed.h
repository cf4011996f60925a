#pragma once
// Faces that look down, moved up by what light bleeds through a layer
// (`--compensate bleed=MM`).
//
// Light goes on below the layer that it should cure: a face that looks down
// comes out lower than drawn by some depth d, unless it lies on the bed. With F
// the solid and b the height of its lowest point, what is printed is
//
//     F ∩ ((F moved up by d) ∪ all below b + d)
//
// so faces that look down rise by d, steep ones as well as flat ones, inside a
// cavity, too; all others stay, and those that are on the bed or nearer to it
// than d: a ball keeps the place on which it stands. This is a change of the
// program of the scene: exact, whatever the layers are. It is written as
// F − (box − F moved up), with a box around all of F above b + d, because what
// has a color stays one operand of unions and differences then (decision 60).
//
// Supports stay as they are, beside the part: nobody measures them. They are in
// the F that moves up, so the part keeps what stands on their tips.
//
// Walls lower than d vanish, and gaps lower than d, which the light closes, are
// not opened. Both are looked for in layers: no exact Boolean of few operands
// has them.

#include <cstddef>
#include <optional>

#include "base/diagnostic.h"
#include "csg/scene.h"
#include "slicer/slice/settings.h"

namespace lamina::slicer {

// What the compensation of bleeding light cannot mend, in layers of the run.
struct BleedLosses {
  std::size_t layers = 0;  // in which something is lost
  double area = 0;         // the greatest of a layer [mm²]
  Vec3 place = Vec3(0);    // in that layer
};

struct BleedReport {
  double depth = 0;   // [mm]
  BleedLosses walls;  // that are lower than the depth, and vanish
  BleedLosses gaps;   // that are lower than the depth, and will close
};

// Changes a scene so that its print has the heights of the scene. Slices it to
// find what is too low, and warns of that. A scene of nothing stays.
//
// depth     how far below a layer its light cures [mm]; 0 changes nothing
// settings  of the layers in which losses are looked for
BleedReport compensate_bleed(csg::Scene& scene, double depth,
                             const Settings& settings,
                             Diagnostics& diagnostics);

}  // namespace lamina::slicer
