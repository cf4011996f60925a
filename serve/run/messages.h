#pragma once
// What the compiler says, as JSON for other programs.

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/diagnostic.h"
#include "compiler/compilation.h"
#include "parser/ast.h"

namespace lamina::serve {

// In one line. Bytes that are not UTF-8 are replaced: names of files and
// messages can hold any.
std::string text_of(const nlohmann::ordered_json& json);

// A list of the messages, each with its place and as a terminal shows it; one
// that comes again is there once, with a count. Files are named from `folder`.
nlohmann::ordered_json messages_json(const std::vector<Diagnostic>& messages,
                                     const std::string& folder);

// The list of a design's parameters as `-o x.param` writes it, each with the
// word of its widget, if it has one.
nlohmann::ordered_json parameters_of(const ast::Program& program);

// How the work of a run ended; broken is our own fault, not the design's.
enum class Ending { kDone, kFailed, kBroken };

// Does the work of a run and reports what it throws.
//
// work  returns whether it is done
Ending run_caught(compiler::Compilation& compilation,
                  const std::function<bool()>& work);

}  // namespace lamina::serve
