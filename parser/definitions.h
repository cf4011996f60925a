#pragma once
// What `-D` sets, held against what the design has.

#include "base/diagnostic.h"
#include "parser/ast.h"
#include "parser/loader.h"

namespace lamina {

// Warns of each definition whose name no file of the design has, and of each
// whose value the comment behind the design's own does not allow. Names
// with `$` are always there.
void check_definitions(const ast::Program& program, const Loader& loader,
                       Diagnostics& diagnostics);

}  // namespace lamina
