#pragma once
// The direction of building (`--axis`), the choice of a good one, and where the
// part stands.
//
// After Byun and Lee, Determination of the optimal build direction for
// different rapid prototyping processes using multi-criterion decision making,
// Robotics and Computer-Integrated Manufacturing 22 (2006): the direction whose
// steps deviate least from the surface, by the sum of area times cusp
// (adaptive.h), then the lowest, for each layer takes the same time.
//
// Both are the same upside down. The least surface that hangs over and wants
// supports, as theirs too, decides between those, and then the most surface
// that lies on the bed.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "csg/boundary/boundary_faces.h"
#include "csg/scene.h"

namespace lamina::slicer {

// In the order in which they are preferred, all else being equal.
inline constexpr std::array<std::string_view, 6> kAxes = {"z",  "x",  "y",
                                                          "-x", "-y", "-z"};

// The right-handed turn that makes `axis`, one of kAxes, the building
// direction, and turns the part about it.
//
// degrees  anticlockwise, seen from above
Affine turn_to_axis(std::string_view axis, double degrees = 0);

// The least turn that makes `up`, of any length but 0, point up.
Affine turn_upwards(Vec3 up);

// The merits of a direction.
struct Orientation {
  std::string_view axis;
  double cusp_error = 0;  // area · cusp [mm³]
  Vec3 size = Vec3(0);    // of the surface, as it stands [mm]
  // Surface that looks down by more than 45° and does not lie on the bed [mm²].
  double overhang = 0;
  double footing = 0;  // surface that lies on the bed [mm²]
  // Into the printer: as it stands, or turned by this [degrees].
  bool fits = true;
  double turn = 0;
  // What would go wrong in the print: "2 islands"; empty where nothing is
  // known.
  std::string problems;
};

struct OrientationChoice {
  std::array<Orientation, 6> all;  // as kAxes
  std::size_t best = 0;            // into `all`
  std::string reason;              // for the user: where it is best
};

// Chooses among those directions that fit, if any does.
//
// thickness  of layers [mm]
// volume     that the printer builds [mm]; infinite where none is known
OrientationChoice choose_orientation(const csg::Scene& scene, double thickness,
                                     Vec3 volume);

// For the user: the choice, its reason, and a line for each direction, without
// the last '\n'.
std::string orientation_table(const OrientationChoice& choice);

// How far the surface of a solid, not its leaves, reaches up and down [mm]; low
// > high where nothing is solid.
struct SurfaceHeights {
  double low = 1e300;
  double high = -1e300;

  bool is_empty() const { return low > high; }
};

// Looks at faces beyond those found so far only.
//
// finder  of the scene
SurfaceHeights surface_heights(const csg::Scene& scene,
                               csg::BoundaryFinder& finder);

// The height of the solid's lowest point; of the scene's box where nothing is
// solid.
double lowest_point(const csg::Scene& scene);

// Shifts the scene upwards or downwards until its lowest point is at height 0;
// x and y stay.
void place_on_bed(csg::Scene& scene);

}  // namespace lamina::slicer
