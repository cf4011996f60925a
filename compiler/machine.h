#pragma once
// What the print is made with.

#include <string>

#include "base/file/file_access.h"
#include "compiler/request.h"
#include "slicer/machine/estimate.h"

namespace lamina::compiler {

using slicer::Machine;

// The profiles that are asked for, with the prices that are given; of images
// else the format's usual printer. Throws FileError where a profile cannot be
// opened, and where a material is not of the kind that is asked for.
Machine choose_machine(const OutputRequest& request, const FileAccess& access);

// The options with which a part that is too large for the printer would fit,
// such as "--axis x --turn 90"; empty where none help.
//
// size  of the part as `geometry` has it stand [mm]
std::string options_that_fit(const slicer::Printer& printer,
                             const GeometryRequest& geometry, Vec3 size);

}  // namespace lamina::compiler
