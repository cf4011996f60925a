#pragma once
// What is probably not as its author means it, though it can be made.

#include "base/diagnostic.h"
#include "compiler/machine.h"
#include "compiler/request.h"
#include "csg/lower/lower.h"

namespace lamina::compiler {

// Warns of a size that suggests other units, of settings that an outline has no
// use for, and of heights outside the design.
void warn_of_geometry(const csg::Lowered& lowered, const Request& request,
                      Diagnostics& diagnostics);

// Warns of an archive that the printer does not read, and of an exposure that
// is for another printer or thickness.
void warn_of_machine(const Machine& machine, const Request& request,
                     Diagnostics& diagnostics);

}  // namespace lamina::compiler
