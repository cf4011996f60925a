#pragma once
// Values of parameters written back into the text of a design.

#include <string>

#include "base/diagnostic.h"
#include "parser/ast.h"
#include "parser/customizer/parameter_set.h"
#include "parser/language.h"

namespace lamina::studio {

struct SourceEdit {
  std::string before;  // the text of the file as it was read
  std::string text;    // with the values
  std::string diff;    // as `diff -U0` shows it; empty where they are equal
  std::string key;     // of both texts
};

// Puts the values in the places of the literals that they replace; all else
// stays as it is written. Reports what the design does not take.
//
// program  as it was read
SourceEdit edit_source(const ast::Program& program, const ParameterSet& values,
                       Language language, Diagnostics& diagnostics);

}  // namespace lamina::studio
