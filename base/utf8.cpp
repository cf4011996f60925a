#include "base/utf8.h"

#include <algorithm>

namespace lamina {

namespace {
bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}
// GLib's g_unichar_validate.
bool is_character(std::uint32_t c) {
  return c < 0x110000 && (c & 0xFFFFF800) != 0xD800;
}
constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
}  // namespace

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

bool is_valid_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::uint32_t length = utf8_length(text[0]);
    if (length > 4 || length > text.size()) return false;
    const std::uint32_t value = first_code_point(text);
    if (!is_character(value) || value < kLeast[length] || value == 0) {
      return false;
    }
    text.remove_prefix(length);
  }
  return true;
}

void append_utf8(double code_point, std::string& text) {
  if (!(code_point >= 1) || code_point >= 0x110000) return;
  const auto c = static_cast<std::uint32_t>(code_point);
  if (!is_character(c)) return;
  const auto put = [&text](std::uint32_t byte) {
    text.push_back(static_cast<char>(byte));
  };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6);
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18);
    put(0x80 | (c >> 12 & 0x3F));
    put(0x80 | (c >> 6 & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

}  // namespace lamina
