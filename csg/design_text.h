#pragma once
// Numbers of OpenSCAD designs that lamina writes.

#include <string>

#include "base/vec.h"

namespace lamina::csg {

// Lengths and places [mm], as short as a micrometre allows: 1.5, [0.125, 0, 2].
std::string design_text(double length);
std::string design_text(Vec3 place);

}  // namespace lamina::csg
