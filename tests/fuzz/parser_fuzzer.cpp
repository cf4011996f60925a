// Lexer, parser and the printer of syntax trees, which takes its own text back:
// a printed program, parsed and printed again, is the same text. But for one
// thing: as OpenSCAD does, it prints a function as an operand without the
// brackets that it needs, "(1 + function(x) x)".

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/ast_printer.h"
#include "parser/loader.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

// As `-o x.ast` prints it; nothing after a syntax error.
std::optional<std::string> print(const std::string& text) {
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  std::optional<std::string> printed;
  try {
    printed = ast::print(loader.load_text("x.scad", text));
  } catch (const SyntaxError&) {
  }
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    caret_text(diagnostic);
    openscad_line(diagnostic, "");
  }
  return printed;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  // In a module, where the customizer writes no comments.
  const std::string text(fuzz::as_text(data, size));
  print(text);
  const auto printed = print("module m() {" + text + "\n}");
  if (!printed) return 0;
  const auto again = print(*printed);
  const bool has_function = printed->find("function(") != std::string::npos;
  fuzz::require(again ? again == printed : has_function, "prints itself");
  return 0;
}
