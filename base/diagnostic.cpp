#include "base/diagnostic.h"

#include <algorithm>
#include <deque>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/text.h"
#include "base/utf8.h"

namespace lamina {

namespace {

// How messages of OpenSCAD's parser begin. It shows their places relative to
// the folder in which it runs, and does not count carriage returns in them;
// other places it shows relative to the design.
constexpr std::string_view kParserError = "Parser error: ";

struct Prefix {
  std::string_view openscad;
  std::string_view terminal;
};

Prefix prefix_of(Severity severity) {
  // In the order of the severities.
  constexpr Prefix kPrefixes[] = {{"", ""},
                                  {"ECHO: ", "ECHO: "},
                                  {"DEPRECATED: ", "deprecated: "},
                                  {"WARNING: ", "warning: "},
                                  {"ERROR: ", "error: "}};
  return kPrefixes[static_cast<std::size_t>(severity)];
}

void append_openscad_place(std::string& text, const Source& source,
                           std::uint32_t line, const std::string& base_folder) {
  text += fmt::format(" in file {}, line {}",
                      relative_path(source.path(), base_folder), line);
}

// Text that a terminal shows with one column for each character. Control
// characters would move the cursor, and tabs would shift the carets, so both
// become blanks; bytes that are no UTF-8 become question marks.
std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) {
      result += '?';
    } else if (is_control(first_code_point(text))) {
      result += ' ';
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

// The line of `range` and carets below it, to the end of that line at most.
void append_carets(std::string& text, SourceRange range) {
  constexpr std::size_t kWidest = 200;  // bytes; longer lines are not shown
  const LineColumn place = range.source->line_column(range.begin);
  const std::string_view line = range.source->line_text(place.line);
  if (line.size() > kWidest) return;
  const std::string shown = printable(line);
  if (shown.find_first_not_of(' ') == std::string::npos) return;
  const std::size_t begin =
      std::min<std::size_t>(place.column - 1, line.size());
  const std::size_t end = std::clamp<std::size_t>(
      begin + (range.end - range.begin), begin, line.size());
  const std::size_t indent = utf8_width(printable(line.substr(0, begin)));
  const std::size_t length =
      utf8_width(printable(line.substr(begin, end - begin)));
  text += fmt::format("{:>5} | {}\n      | {:{}}^{:~>{}}\n", place.line, shown,
                      "", indent, "", length > 0 ? length - 1 : 0);
}

// A file's name before ": ", in quotes where it has that itself.
std::string name_of_place(const Source& source) {
  const std::string name = on_one_line(shown_path(source.path()));
  return name.find(": ") == std::string::npos ? name : in_quotes(name);
}

// The message as it is shown. What a design echoes is its own.
std::string shown_message(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::kEcho
             ? diagnostic.message
             : with_display_paths(diagnostic.message);
}

// A place in the file: OpenSCAD's parser finds its end below that.
SourceRange within_file(SourceRange range) {
  if (!range.is_written() || range.is_defined_by_option()) return range;
  const std::uint32_t end = range.source->file_end();
  return range.begin < end ? range : SourceRange{range.source, end, end};
}

void append_terminal_text(std::string& text, SourceRange range,
                          std::string_view prefix, std::string_view message) {
  if (range.is_defined_by_option()) {
    const LineColumn place = range.source->line_column(range.begin);
    std::string_view line = range.source->line_text(place.line);
    if (line.ends_with(';')) line.remove_suffix(1);
    text += fmt::format("-D {}: {}{}\n", printable(line), prefix,
                        message_text(message));
    return;
  }
  if (range.is_written()) {
    const LineColumn place = range.source->line_column(range.begin);
    text += fmt::format("{}:{}:{}: ", name_of_place(*range.source), place.line,
                        place.column);
  } else if (range.is_known()) {
    text += name_of_place(*range.source) + ": ";
  }
  text += fmt::format("{}{}\n", prefix, message_text(message));
  if (range.is_written()) append_carets(text, range);
}

}  // namespace

std::vector<Note> hint_of(std::string text) {
  std::vector<Note> hints;
  if (!text.empty()) hints.push_back({{}, std::move(text)});
  return hints;
}

Error::Error(Diagnostic diagnostic) : diagnostic_(std::move(diagnostic)) {}

Error::Error(std::string message, SourceRange range)
    : diagnostic_{Severity::kError, range, std::move(message)} {}

void fail_check(const char* file, int line, const char* claim,
                const std::string& left, const std::string& right) {
  throw InternalError(
      fmt::format("internal error, please report: {}:{}: {} does not hold: {} "
                  "against {}",
                  file, line, claim, left, right));
}

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

void Diagnostics::own_warning(SourceRange range, std::string message,
                              std::vector<Note> hints) {
  Diagnostic warning{Severity::kWarning, range, std::move(message)};
  warning.hints = std::move(hints);
  warning.audience = Audience::kTerminal;
  report(std::move(warning));
}

void Diagnostics::own_remark(SourceRange range, std::string message) {
  Diagnostic remark{Severity::kPlain, range, std::move(message)};
  remark.audience = Audience::kTerminal;
  report(std::move(remark));
}

void Diagnostics::error(SourceRange range, std::string message,
                        std::vector<Note> notes) {
  report({Severity::kError, range, std::move(message), std::move(notes)});
}

namespace {

// The lines of one message, without line breaks.
std::vector<std::string> openscad_lines(const Diagnostic& diagnostic,
                                        const std::string& base_folder) {
  const auto folder_of_document = [&](const Source* document) {
    return document == nullptr ? base_folder : folder_of(document->path());
  };
  std::vector<std::string> lines;
  std::string text(prefix_of(diagnostic.severity).openscad);
  text += shown_message(diagnostic);
  const SourceRange range = diagnostic.range;
  if (range.is_known()) {
    const bool is_from_parser = diagnostic.message.starts_with(kParserError);
    append_openscad_place(
        text, *range.source,
        is_from_parser ? range.source->line_column(range.begin).line
                       : range.source->openscad_line(range.begin),
        is_from_parser ? "" : folder_of_document(diagnostic.document));
  }
  lines.push_back(std::move(text));
  for (const Note& note : diagnostic.notes) {
    std::string line = "TRACE: " + with_display_paths(note.message);
    if (note.range.is_known()) {
      const Source& source = *note.range.source;
      append_openscad_place(line, source,
                            source.openscad_line(note.range.begin),
                            folder_of_document(note.document));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::string openscad_line(const Diagnostic& diagnostic,
                          const std::string& base_folder) {
  std::string text;
  for (const std::string& line : openscad_lines(diagnostic, base_folder)) {
    text += line + '\n';
  }
  return text;
}

std::string openscad_text(const std::vector<Diagnostic>& diagnostics,
                          const std::string& base_folder) {
  constexpr std::size_t kRemembered = 5;
  std::deque<std::string> last;
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.audience == Audience::kTerminal) continue;
    const bool can_fold = diagnostic.severity == Severity::kWarning ||
                          diagnostic.severity == Severity::kError;
    for (std::string& line : openscad_lines(diagnostic, base_folder)) {
      if (can_fold) {
        if (last.size() == kRemembered &&
            std::count(last.begin(), last.end(), line) == std::ssize(last)) {
          continue;
        }
        if (last.size() == kRemembered) last.pop_front();
        last.push_back(line);
      }
      text += line + '\n';
    }
  }
  return text;
}

std::string caret_text(const Diagnostic& diagnostic) {
  if (diagnostic.audience == Audience::kEcho) return "";
  const SourceRange range = within_file(diagnostic.range);
  std::string text;
  append_terminal_text(text, range, prefix_of(diagnostic.severity).terminal,
                       shown_message(diagnostic));
  for (const auto* notes : {&diagnostic.notes, &diagnostic.hints}) {
    for (const Note& note : *notes) {
      const SourceRange place = within_file(note.range);
      const bool is_shown = place.source == range.source &&
                            place.begin == range.begin &&
                            place.end == range.end;
      append_terminal_text(text, is_shown ? SourceRange() : place,
                           "note: ", with_display_paths(note.message));
    }
  }
  return text;
}

}  // namespace lamina
