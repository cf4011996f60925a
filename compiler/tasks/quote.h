#pragma once
// A quote: what a piece weighs, costs and takes, and what was found in it, as
// JSON for other programs. docs/serve.md says what its members are.

#include <nlohmann/json_fwd.hpp>

#include "compiler/look_at.h"

namespace lamina::compiler {

// compilation  has made its tree and has chosen its machine
// inspection   of its layers
nlohmann::ordered_json quote_json(const Compilation& compilation,
                                  const Inspection& inspection);

// The parameters of a design, as `-o x.param` lists them.
nlohmann::ordered_json parameter_list(const ast::Program& program);

// What the piece would weigh in each metal that lamina knows.
//
// volume  of the piece [mm³]
nlohmann::ordered_json weights_json(double volume);

}  // namespace lamina::compiler
