#pragma once
// UTF-8: well-formed text as the standard has it, broken text as OpenSCAD
// (GLib) counts it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lamina {

// Bytes of the character that begins with `lead`, by that byte alone: broken
// text has a length too.
inline std::uint32_t utf8_length(char lead) {
  const auto byte = static_cast<unsigned char>(lead);
  if (byte < 0xC0 || byte >= 0xFE) return 1;
  if (byte < 0xE0) return 2;
  if (byte < 0xF0) return 3;
  if (byte < 0xF8) return 4;
  return byte < 0xFC ? 5 : 6;
}

// Columns that the text takes, double width neglected.
std::size_t utf8_width(std::string_view text);

// Bytes of the well-formed character at the beginning of `text`, which is not
// empty; 0 where there is none.
std::size_t character_length(std::string_view text);

// Whether all of `text` is well-formed (no overlong forms, no surrogates) and
// holds no zero byte.
bool is_valid_utf8(std::string_view text);

// The first character of a text that may be broken.
std::uint32_t first_code_point(std::string_view text);

// Appends `code_point`. Returns false and appends nothing where there is no
// such character (0, surrogates, beyond U+10FFFF).
bool append_utf8(double code_point, std::string& text);

}  // namespace lamina
