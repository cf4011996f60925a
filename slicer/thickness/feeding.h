#pragma once
// Where a casting is heavy, and whether metal can still reach it.
//
// Metal shrinks as it freezes, thin places before thick ones. What is thick
// must draw metal from the gate through places that are still liquid, so at
// least as thick; else it becomes porous. So on some way from the gate to any
// place the thickness must not rise.
//
// Whether it does is the same question as which summits of a landscape one can
// reach without first going down. The height is the distance from the surface.
// The land above a height falls into parts, which grow together as the height
// sinks: at a saddle, the neck between two thick places. A summit that is
// higher than the saddle where its part joins that of the gate is cut off.
// Without a gate the highest summit of all is the place to feed. Source: the
// merge tree of a height field, Carr, Snoeyink and Axen, Computing contour
// trees in all dimensions, 2003.
//
// Thickness is that of the largest ball inside. Rods freeze faster than plates
// of the same thickness (Chvorinov 1940: by volume per surface): that is not
// looked at.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "slicer/thickness/ball_finder.h"
#include "slicer/thickness/solid_samples.h"

namespace lamina::slicer {

// The radius of the largest ball around each cell of a solid.
struct ThicknessField {
  // Of the largest ball whose centre is in the cell or near: at most kReach
  // pitches from its middle [mm]; by number of the cell.
  std::vector<double> radii;
};

// Half the diagonal of a cell [pitches].
inline constexpr double kReach = 0.8660254037844386;

// The solid, sampled finely enough to see what feeds what: in a ring the cells
// are a tenth of a millimetre wide. Plates that are thousands of times as wide
// as they are thick have none.
SolidSamples sample_casting(const csg::Scene& scene);

ThicknessField measure_thickness(const SolidSamples& samples,
                                 const BallFinder& balls);

// Where metal enters the piece: through the largest ball that reaches there.
struct Gate {
  Vec3 place = Vec3(0);  // on the surface, or near
  double diameter = 0;   // of what feeds it there [mm]; 0: as thick as need be
};

// A part of a casting that freezes from outside to one place.
struct Pool {
  Vec3 place = Vec3(0);  // the middle of its largest ball
  double thickness = 0;  // the diameter of that [mm]
  // The cells that freeze towards it, by ascending number.
  std::vector<std::uint32_t> cells;
  double volume = 0;  // of those [mm³]
  // Where it is joined to another pool or to the gate: the thickest neck. Has
  // no thickness where nothing joins it.
  Vec3 neck = Vec3(0);
  double neck_thickness = 0;  // [mm]
  bool is_fed = false;
};

// A neck that is thinner than what it should feed by no more than this share
// counts as thick enough, and so does one thinner by no more than kNeckDoubt
// pitches: cells do not know better.
inline constexpr double kFeedShare = 0.1;
inline constexpr double kNeckDoubt = 0.5;

// Returns all pools, those that are not fed first, the largest first. Without a
// gate one is fed: the thickest.
std::vector<Pool> find_pools(const SolidSamples& samples,
                             const BallFinder& balls,
                             const ThicknessField& field,
                             const std::vector<Gate>& gates);

}  // namespace lamina::slicer
