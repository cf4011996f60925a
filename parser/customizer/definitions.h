#pragma once
// What `-D` and tables can set: the variables of a design, and definitions held
// against them.

#include <functional>
#include <map>
#include <string>

#include "base/diagnostic.h"
#include "parser/ast.h"
#include "parser/loader.h"
#include "parser/tree_facts.h"

namespace lamina {

// The variables of a design that can be set from outside, and what type of
// value each one has by itself.
using Variables = std::map<std::string, ast::ValueType, std::less<>>;

// Returns what `-D` can set: variables of the main file, of what it includes,
// and of the files that it uses. The last value of a name gives its type, in
// the main file if it is there.
Variables find_variables(const ast::Program& program, const Loader& loader);

// Warns of each definition whose name no file of the design has, and of each
// whose value the comment behind the design's own does not allow. Names
// with `$` are always there.
void check_definitions(const ast::Program& program, const Loader& loader,
                       Diagnostics& diagnostics);

}  // namespace lamina
