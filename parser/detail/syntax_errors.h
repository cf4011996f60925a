#pragma once
// Errors of the parser, in OpenSCAD's words ("Parser error: …") with hints
// that only the terminal shows.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/source.h"

namespace lamina::detail {

// Greatest depth of a tree, and of Bison's stack. A pass that needs up to
// 4 KiB a level fits in a stack of 1 GiB; OpenSCAD ends at 20000.
constexpr std::uint32_t kDeepestTree = 250'000;

// Returns what to say besides OpenSCAD's two words: "unexpected ';', expected
// ']' or ','".
//
// symbol    what the grammar calls the token where the error is
// text      the token
// expected  the grammar's names of all tokens that could stand there
std::string describe_syntax_error(std::string_view symbol,
                                  std::string_view text,
                                  std::vector<std::string_view> expected);

class SyntaxErrors {
 public:
  explicit SyntaxErrors(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void report(SourceRange range, std::string_view message,
              std::vector<Note> hints);
  // Reports a text that ends within what opened at `range`. OpenSCAD adds a
  // line.
  void report_unterminated(SourceRange range, const char* what,
                           std::vector<Note> hints);
  // Reports, once, that a tree is deeper than kDeepestTree.
  void report_depth(SourceRange range);

  bool is_empty() const { return count_ == 0; }
  // Whether a text has so many errors that reading on shows nothing new.
  bool are_too_many() const;
  // Throws the first error; there must be one.
  [[noreturn]] void throw_first() const;

 private:
  Diagnostics& diagnostics_;
  int count_ = 0;
  bool is_too_deep_ = false;
  Diagnostic first_;
};

}  // namespace lamina::detail
