#pragma once
// A text, parsed: what the tests of the parser ask for.

#include <functional>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/ast.h"
#include "parser/loader.h"

namespace lamina {

// Runs `work` on a thread with as much stack as the program gives its passes.
void run_on_large_stack(const std::function<void()>& work);

class Parsed {
 public:
  // Parses `text` as the file "x.scad" of a folder with no other files.
  explicit Parsed(const std::string& text, const std::string& definitions = "");

  bool has_failed() const { return !program_; }
  const ast::Program& program() const { return *program_; }

  // As `-o x.ast` prints it; "" after a syntax error.
  std::string ast() const;

  // The expression `text`, printed: `expression_text("1+2")` is "(1 + 2)".
  static std::string expression(const std::string& text);

  // All messages as `.echo` and as the terminal shows them.
  std::string openscad_text() const;
  std::string terminal_text() const;

  const std::vector<Diagnostic>& messages() const { return diagnostics_.all(); }

 private:
  SourceStore sources_;
  Diagnostics diagnostics_;
  Loader loader_;
  std::optional<ast::Program> program_;
};

}  // namespace lamina
