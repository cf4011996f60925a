#include "parser/detail/syntax_errors.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace lamina::detail {

// --- What to say
// -------------------------------------------------------------- Bison knows
// all tokens that could stand where the error is; after an operand these are
// two dozen. A person needs few of them: operators go without saying, and all
// that begins an expression is "an expression".

namespace {

using Symbols = std::vector<std::string_view>;

bool contains(const Symbols& symbols, std::string_view symbol) {
  return std::find(symbols.begin(), symbols.end(), symbol) != symbols.end();
}

void remove(Symbols& symbols,
            std::initializer_list<std::string_view> unwanted) {
  std::erase_if(symbols, [&](std::string_view symbol) {
    return std::find(unwanted.begin(), unwanted.end(), symbol) !=
           unwanted.end();
  });
}

// Bison quotes characters, but neither keywords nor operators of two signs.
std::string describe_symbol(std::string_view symbol) {
  const bool is_plain = symbol.starts_with('\'') || symbol.starts_with("a ") ||
                        symbol.starts_with("an ") || symbol == "number" ||
                        symbol == "string";
  if (symbol == "name") return "a name";
  return is_plain ? std::string(symbol) : fmt::format("'{}'", symbol);
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x80;
  });
}

std::string explain_invalid(std::string_view text) {
  if (text[0] == '.' || (text[0] >= '0' && text[0] <= '9')) {
    return fmt::format("'{}', which is beyond the greatest number", text);
  }
  if (!is_ascii(text) && text.size() == 1) {
    return fmt::format("byte 0x{:02X}, which is no UTF-8",
                       static_cast<unsigned char>(text[0]));
  }
  if (!is_ascii(text)) {
    return fmt::format("'{}': only strings and comments may hold it", text);
  }
  return fmt::format("byte 0x{:02X}", static_cast<unsigned char>(text[0]));
}

std::string describe_token(std::string_view symbol, std::string_view text) {
  constexpr std::size_t kLongest = 40;  // bytes; longer tokens are not repeated
  if (symbol == "end of the definition") return std::string(symbol);
  if (symbol.starts_with("end of")) return "end of the file";
  if (text.size() > kLongest) return describe_symbol(symbol);
  return fmt::format("'{}'", text);
}

std::string describe_expected(Symbols symbols) {
  remove(symbols, {"use <file>", "end of file", "end of the file"});
  if (contains(symbols, "||")) {
    remove(symbols, {"||",  "&&",  "==",  "!=",  "<=",  ">=",  "<<",  ">>",
                     "'<'", "'>'", "'|'", "'&'", "'+'", "'-'", "'*'", "'/'",
                     "'%'", "'^'", "'('", "'['", "'.'", "'?'"});
  }
  if (contains(symbols, "number")) {
    remove(symbols, {"number", "string", "name", "true", "false", "undef",
                     "let", "assert", "echo", "function", "for", "if", "each",
                     "'('", "'['", "'+'", "'-'", "'!'", "'~'"});
    symbols.insert(symbols.begin(), "an expression");
  }
  if (contains(symbols, "'#'")) {
    const bool is_statement = contains(symbols, "module");
    remove(symbols, {"module", "function", "name", "let", "assert", "echo",
                     "for", "if", "each", "'!'", "'#'", "'%'", "'*'"});
    if (is_statement) remove(symbols, {"';'", "'{'"});
    symbols.push_back(is_statement ? "a statement" : "a module");
  }
  std::string text;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    const bool is_last = i + 1 == symbols.size();
    text += i == 0 ? ", expected " : is_last ? " or " : ", ";
    text += describe_symbol(symbols[i]);
  }
  return text;
}

}  // namespace

std::string describe_syntax_error(std::string_view symbol,
                                  std::string_view text, Symbols expected) {
  constexpr std::array<std::string_view, 6> kQuotes = {
      "'", "\u201c", "\u201d", "\u201e", "\u2018", "\u2019"};
  if (contains({kQuotes.begin(), kQuotes.end()}, text)) {
    return fmt::format(
        "unexpected '{}': strings stand in straight double "
        "quotes, \"…\"",
        text);
  }
  // A character that no text may hold says enough by itself.
  if (symbol == "invalid character") {
    return "unexpected " + explain_invalid(text);
  }
  return "unexpected " + describe_token(symbol, text) +
         describe_expected(std::move(expected));
}

// --- Errors
// -------------------------------------------------------------------

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
