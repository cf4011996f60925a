#include "base/utf8.h"

#include <algorithm>

#include <utf8.h>

namespace lamina {

namespace {
bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

// Whether the second byte makes no overlong form, no surrogate and nothing
// beyond U+10FFFF (Unicode, table 3-7).
bool can_follow(unsigned char lead, unsigned char second) {
  switch (lead) {
    case 0xE0:
      return second >= 0xA0;
    case 0xED:
      return second < 0xA0;
    case 0xF0:
      return second >= 0x90;
    case 0xF4:
      return second < 0x90;
    default:
      return true;
  }
}
}  // namespace

std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return 1;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = utf8_length(text[0]);
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  if (!can_follow(lead, static_cast<unsigned char>(text[1]))) return 0;
  return length;
}

bool is_valid_utf8(std::string_view text) {
  return utf8::is_valid(text.begin(), text.end()) &&
         text.find('\0') == std::string_view::npos;
}

std::size_t utf8_width(std::string_view text) {
  return text.size() -
         static_cast<std::size_t>(std::ranges::count_if(text, is_continuation));
}

std::uint32_t first_code_point(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::uint32_t length = utf8_length(text[0]);
  if (lead < 0x80) return lead;
  if (length == 1 || length > text.size()) return 0xFFFFFFFF;
  std::uint32_t value = lead & (0x7FU >> length);
  for (std::uint32_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0xFFFFFFFF;
    value = value << 6 | (static_cast<unsigned char>(text[i]) & 0x3FU);
  }
  return value;
}

bool append_utf8(double code_point, std::string& text) {
  if (!(code_point >= 1) || code_point >= 0x110000) return false;
  const auto character = static_cast<char32_t>(code_point);
  if (character >= 0xD800 && character < 0xE000) return false;
  utf8::append(character, text);
  return true;
}

}  // namespace lamina
