#pragma once
// Numbers and strings as OpenSCAD shows them, and words of messages.
//
// OpenSCAD writes the numbers of values with double-conversion (six significant
// digits, zeros at the end cut off: 1e+6) and those of most module parameters
// with C++ streams (`%g`: 1e+06). Both are here, because a `.csg` file mixes
// them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace lamina {

// Appends a number as OpenSCAD shows values: 0.333333, 1e+6, inf, nan; never
// -0.
void append_number(double number, std::string& text);

// Appends a number as C++ streams show it: 0.333333, 1e+06, inf, -nan, -0.
void append_stream_number(double number, std::string& text);

// "…" with \t \n \r \" \\ escaped.
std::string in_quotes(std::string_view content);

// Whether a character steers a terminal or turns the order of letters around:
// C0 and C1 controls, marks of direction (UAX 9), separators of lines.
bool is_control(std::uint32_t code_point);

// A stranger's text as messages show it: controls stand as "\u001B", and bytes
// that are not UTF-8 as U+FFFD. Tabs and newlines stay.
std::string without_controls(std::string_view text);

// A stranger's text as words of a message: without controls, and further lines
// begin with "| ", so that they do not look like messages of their own.
std::string message_text(std::string_view message);

// Without controls on one line: a newline stands as "\u000A", a tab as a blank.
std::string on_one_line(std::string_view text);

// A name among other words of a message: on one line, and of a long one the
// first 100 characters and "…".
std::string short_name(std::string_view name);

// As the text of an HTML or SVG element, or a quoted attribute.
std::string escape_html(std::string_view text);

// Bytes in letters (RFC 4648): as pages hold pictures and numbers.
std::string base64(std::string_view bytes);

std::string first_line(std::string_view text);

// Blanks of ASCII: of plain text, not of Unicode.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' ||
         c == '\f';
}

// Without the blanks at both ends.
inline std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// "1 layer", "98 layers", "2 vertices".
//
// more  the word for several; empty: `one` with an s
std::string counted(std::uint64_t count, std::string_view one,
                    std::string_view more = {});

// A place rounded to hundredths, without -0 [mm]; and "1.50, 0.00, 21.32": how
// messages and lists have it.
Vec3 in_hundredths(Vec3 place);
std::string place_text(Vec3 place);

// A finite number and nothing else, such as "-1.5e3"; no value for all other
// texts. For what people type outside of a design: options, cells of tables.
std::optional<double> parse_number(std::string_view text);

}  // namespace lamina
