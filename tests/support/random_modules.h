#pragma once
// Random designs out of nearly all modules of the language, not only Booleans
// of placed primitives: hulls, Minkowski sums, shadows and cuts, offsets,
// extrusions straight, twisted and turned, polyhedra good and bad.
//
// Numbers are few and round, so that faces, edges and corners meet all the
// time, solids are copied onto themselves, and now and then a size is 0 or a
// matrix singular. A choice of 0 is the simplest everywhere: a cube.

#include <cstddef>
#include <string>

#include "tests/support/choices.h"

namespace lamina::support {

// One solid, maybe empty, of at most `leaf_count` primitives, within some 40 mm
// of the origin.
std::string random_modules(Choices& choices, std::size_t leaf_count);

// One shape of the plane, likewise.
std::string random_shape(Choices& choices, std::size_t leaf_count);

}  // namespace lamina::support
