#pragma once
// How far from the origin lamina goes.

namespace lamina::csg {

// Up to here doubles are ten times finer than the distance at which faces tie,
// and here ends the polygon clipper's grid [mm]. Layers of what lies beyond
// would be wrong, so it is refused.
constexpr double kGreatestCoordinate = 1e9;

}  // namespace lamina::csg
