#pragma once
// What the print is made with.

#include <optional>
#include <string>

#include "base/file/file_access.h"
#include "compiler/request.h"
#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::compiler {

struct Machine {
  std::optional<slicer::Printer> printer;
  std::optional<slicer::Material> material;
};

// The profiles that are asked for; of images else the format's usual printer.
// Throws FileError where a profile cannot be opened.
Machine choose_machine(const OutputRequest& request, const FileAccess& access);

// The options with which a part that is too large for the printer would fit,
// such as "--axis x --turn 90"; empty where none help.
//
// size  of the part as `geometry` has it stand [mm]
std::string options_that_fit(const slicer::Printer& printer,
                             const GeometryRequest& geometry, Vec3 size);

}  // namespace lamina::compiler
