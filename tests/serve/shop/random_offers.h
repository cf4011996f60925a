#pragma once
// Random designs, and values for their parameters of which about half are
// offered: on limits and steps, and next to them.

#include <string>

#include <nlohmann/json.hpp>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/ast.h"
#include "tests/support/choices.h"

namespace lamina::shop {

// A design that has been read.
class ReadDesign {
 public:
  explicit ReadDesign(const std::string& text);
  ast::Program& program() { return program_; }
  nlohmann::ordered_json parameters() const;

 private:
  SourceStore sources_;
  Diagnostics diagnostics_;
  ast::Program program_;
};

// A few parameters, of any kind and with any comment.
std::string random_design(support::Choices& choices);

// Values for some of the parameters.
nlohmann::ordered_json random_values(const nlohmann::ordered_json& parameters,
                                     support::Choices& choices);

}  // namespace lamina::shop
