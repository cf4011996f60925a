#pragma once
// The variables of a design that can be set from outside, and what kind of
// value each one has by itself.

#include <cstdint>
#include <map>
#include <string>

#include "parser/ast.h"
#include "parser/loader.h"

namespace lamina {

// kAny: not known without evaluating the design.
enum class VariableKind : std::uint8_t {
  kAny,
  kBool,
  kNumber,
  kString,
  kVector
};

using Variables = std::map<std::string, VariableKind, std::less<>>;

// What `-D` can set: variables of the main file, of what it includes, and of
// the files that it uses. The last value of a name gives its kind, in the main
// file if it is there.
Variables find_variables(const ast::Program& program, const Loader& loader);

}  // namespace lamina
