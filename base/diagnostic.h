#pragma once
// The messages of a run: echoes, warnings, errors, each with its place.
//
// Passes append and go on; only the program prints. A Diagnostic keeps
// OpenSCAD's words exactly and without place; `openscad_line` adds the place as
// OpenSCAD 2021.01 writes it (`.echo` files), `caret_text` as a terminal shows
// it.

#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "base/source.h"

namespace lamina {

// kPlain: a line that OpenSCAD prints without a prefix.
enum class Severity { kPlain, kEcho, kDeprecated, kWarning, kError };

// Where a message appears. The terminal has all errors of a text, each once;
// OpenSCAD's parser ends at the first, which it may put in two lines.
enum class Audience { kAll, kTerminal, kEcho };

// A further place that belongs to a diagnostic: a caller in a call chain.
struct Note {
  SourceRange range;
  std::string message;  // "called by 'f'", as after OpenSCAD's "TRACE: "
  const Source* document = nullptr;  // as in Diagnostic
};

// A note without a place; none of an empty text.
std::vector<Note> hint_of(std::string text);

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceRange range;    // unknown where OpenSCAD gives no place either
  std::string message;  // OpenSCAD's words without prefix and place
  std::vector<Note> notes = {};
  // What OpenSCAD does not say: shown on the terminal only, after the notes.
  std::vector<Note> hints = {};
  // The file to whose folder OpenSCAD shows paths relative (for much of what
  // comes up in a used file, that file); null: the design.
  const Source* document = nullptr;
  Audience audience = Audience::kAll;
};

// Thrown where a run cannot go on.
class Error : public std::exception {
 public:
  explicit Error(Diagnostic diagnostic);
  // An error with a place, or without one.
  explicit Error(std::string message, SourceRange range = {});
  const char* what() const noexcept override;
  const Diagnostic& diagnostic() const { return diagnostic_; }

 private:
  Diagnostic diagnostic_;
};
struct SyntaxError : Error {
  using Error::Error;
};
struct FileError : Error {
  using Error::Error;
};
struct GeometryError : Error {
  using Error::Error;
};
struct EvaluationError : Error {
  using Error::Error;
};

// LAMINA_CHECK_EQ found a promise of our own broken.
struct InternalError : Error {
  using Error::Error;
};

// The run's messages in the order in which they came up.
class Diagnostics {
 public:
  // Called with every message as it comes up (a terminal wants an echo at
  // once, not at the end of the run).
  using Observer = std::function<void(const Diagnostic&)>;

  explicit Diagnostics(Observer observer = nullptr);

  // Under hard warnings the first warning is reported and then thrown as
  // Error.
  void set_hard_warnings(bool hard) { hard_warnings_ = hard; }
  bool has_hard_warnings() const { return hard_warnings_; }

  void report(Diagnostic diagnostic);
  void echo(std::string text);
  void warning(SourceRange range, std::string message,
               std::vector<Note> notes = {});
  // Warns of what OpenSCAD does not say, on the terminal only.
  void own_warning(SourceRange range, std::string message,
                   std::vector<Note> hints = {});
  // Remarks on it without a warning.
  void own_remark(SourceRange range, std::string message);
  void error(SourceRange range, std::string message,
             std::vector<Note> notes = {});

  const std::vector<Diagnostic>& all() const { return all_; }
  bool has_errors() const { return has_errors_; }

 private:
  Observer observer_;
  std::vector<Diagnostic> all_;
  bool hard_warnings_ = false;
  bool has_errors_ = false;
};

// The exact lines of OpenSCAD 2021.01, each ended by '\n': the message, with
// "in file …, line …" where it has a place, then a TRACE line for each note.
// File names are relative to `base_folder`, the folder of the design.
std::string openscad_line(const Diagnostic& diagnostic,
                          const std::string& base_folder);

// What `.echo` holds for the messages of a run. Like OpenSCAD, it drops a
// warning, error or TRACE line that equals each of the last five.
std::string openscad_text(const std::vector<Diagnostic>& diagnostics,
                          const std::string& base_folder);

// As a terminal shows it, with nothing in it that would steer one; further
// lines of a message begin with "| ".
//
// "file:line:column: warning: …", the line of text, carets below it, and the
// notes; ends with '\n'. Empty for a message that is not for the terminal.
std::string caret_text(const Diagnostic& diagnostic);

}  // namespace lamina

// Checks that stay on in release: throw InternalError with both values.
#include "base/check.h"  // IWYU pragma: export
