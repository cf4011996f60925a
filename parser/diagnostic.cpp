#include "parser/diagnostic.h"

#include <utility>

namespace lamina {

Error::Error(Diagnostic diagnostic) : diagnostic_(std::move(diagnostic)) {}

const char* Error::what() const noexcept { return diagnostic_.message.c_str(); }

Diagnostics::Diagnostics(Observer observer) : observer_(std::move(observer)) {}

void Diagnostics::report(Diagnostic diagnostic) {
  all_.push_back(std::move(diagnostic));
  const Diagnostic& reported = all_.back();
  if (reported.severity == Severity::kError) has_errors_ = true;
  if (observer_) observer_(reported);
  if (hard_warnings_ && reported.severity == Severity::kWarning) {
    throw Error(reported);
  }
}

void Diagnostics::echo(std::string text) {
  report({Severity::kEcho, {}, std::move(text), {}});
}

void Diagnostics::warning(SourceRange range, std::string message,
                          std::vector<Note> notes) {
  report({Severity::kWarning, range, std::move(message), std::move(notes)});
}

void Diagnostics::error(SourceRange range, std::string message,
                        std::vector<Note> notes) {
  report({Severity::kError, range, std::move(message), std::move(notes)});
}

}  // namespace lamina
