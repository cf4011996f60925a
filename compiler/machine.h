#pragma once
// What the print is made with.

#include <optional>

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

}  // namespace lamina::compiler
