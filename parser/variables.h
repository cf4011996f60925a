#pragma once
// The variables of a design that can be set from outside, and what type of
// value each one has by itself.

#include <map>
#include <string>

#include "parser/ast.h"
#include "parser/loader.h"
#include "parser/tree_facts.h"

namespace lamina {

using Variables = std::map<std::string, ast::ValueType, std::less<>>;

// What `-D` can set: variables of the main file, of what it includes, and of
// the files that it uses. The last value of a name gives its type, in the main
// file if it is there.
Variables find_variables(const ast::Program& program, const Loader& loader);

}  // namespace lamina
