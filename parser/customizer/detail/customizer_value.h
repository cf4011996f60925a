#pragma once
// The notation in which the customizer writes values: in the comment behind a
// parameter, and in files of parameter sets.

#include <string_view>

#include "parser/ast.h"

namespace lamina::detail {

// The value as an expression in `arena`; null where the text makes no sense.
const ast::Expr* read_customizer_value(std::string_view text, Arena& arena);

}  // namespace lamina::detail
