#pragma once
// UTF-8 as OpenSCAD counts it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lamina {

// Bytes of the character that begins with `lead`, by that byte alone: broken
// text has a length too, the one that OpenSCAD (GLib) gives it.
inline std::uint32_t utf8_length(char lead) {
  const auto byte = static_cast<unsigned char>(lead);
  if (byte < 0xC0 || byte >= 0xFE) return 1;
  if (byte < 0xE0) return 2;
  if (byte < 0xF0) return 3;
  if (byte < 0xF8) return 4;
  return byte < 0xFC ? 5 : 6;
}

// Whether all of `text` is well-formed (no overlong forms, no surrogates).
bool is_valid_utf8(std::string_view text);

// The first character of a text that may be broken.
std::uint32_t first_code_point(std::string_view text);

// Appends `code_point`; nothing where no such character exists (0, surrogates,
// beyond U+10FFFF).
void append_utf8(double code_point, std::string& text);

}  // namespace lamina
