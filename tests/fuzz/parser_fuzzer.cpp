// Lexer, parser and the printer of syntax trees, which takes its own text back:
// a printed program, parsed and printed again, is the same text. But for two
// things, as OpenSCAD prints them: a function as an operand goes without the
// brackets that it needs, "(1 + function(x) x)", and "1e3.x" becomes "1000.x",
// which is the number "1000." before a name.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <regex>
#include <string>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/customizer/program_printer.h"
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

bool may_be_unreadable(const std::string& printed) {
  static const std::regex member_of_number("[0-9]\\.[A-Za-z_]");
  return printed.find("function(") != std::string::npos ||
         std::regex_search(printed, member_of_number);
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
  fuzz::require(again ? again == printed : may_be_unreadable(*printed),
                "prints itself");
  return 0;
}
