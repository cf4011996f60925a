#include "parser/detail/syntax_errors.h"

#include <utility>

#include <fmt/format.h>

namespace lamina::detail {

void SyntaxErrors::report(SourceRange range, std::string_view message,
                          std::vector<Note> hints) {
  Diagnostic error{Severity::kError,
                   range,
                   fmt::format("Parser error: {}", message),
                   {},
                   std::move(hints)};
  if (count_ == 0) {
    first_ = error;
  } else {
    error.audience = Audience::kTerminal;
  }
  ++count_;
  diagnostics_.report(std::move(error));
}

void SyntaxErrors::report_unterminated(SourceRange range, const char* what,
                                       std::vector<Note> hints) {
  const bool is_first = is_empty();
  report(range, fmt::format("Unterminated {}", what), std::move(hints));
  if (!is_first) return;
  Diagnostic second{Severity::kError, range, "Parser error: syntax error"};
  second.audience = Audience::kEcho;
  diagnostics_.report(std::move(second));
}

void SyntaxErrors::report_depth(SourceRange range) {
  if (is_too_deep_) return;
  is_too_deep_ = true;
  report(range, "memory exhausted",
         {{{}, fmt::format("nested more than {} deep", kDeepestTree)}});
}

bool SyntaxErrors::are_too_many() const {
  constexpr int kMost = 20;
  return count_ >= kMost;
}

void SyntaxErrors::throw_first() const { throw SyntaxError(first_); }

}  // namespace lamina::detail
