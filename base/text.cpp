#include "base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <double-conversion/double-conversion.h>
#include <fmt/format.h>

#include "base/utf8.h"

namespace lamina {

namespace {

// The parameters with which OpenSCAD 2021.01 makes its converter.
const double_conversion::DoubleToStringConverter& converter() {
  using double_conversion::DoubleToStringConverter;
  static const DoubleToStringConverter instance(
      DoubleToStringConverter::UNIQUE_ZERO |
          DoubleToStringConverter::EMIT_POSITIVE_EXPONENT_SIGN,
      "inf", "nan", 'e', -6, 21, 5, 0);
  return instance;
}
constexpr int kDigits = 6;

// Cuts zeros off the end of the fraction, and the point with them.
void append_trimmed(std::string_view digits, std::string& text) {
  const std::size_t point = digits.find('.');
  if (point == std::string_view::npos) {
    text += digits;
    return;
  }
  const std::size_t exponent = std::min(digits.find('e'), digits.size());
  std::size_t end = exponent;
  while (digits[end - 1] == '0') --end;
  if (end == point + 1) end = point;
  text += digits.substr(0, end);
  text += digits.substr(exponent);
}

// Whole numbers of up to six digits are most of all numbers and need no
// general conversion.
bool append_small_integer(double number, std::string& text) {
  if (!(std::fabs(number) < 1e6)) return false;
  const int integer = static_cast<int>(number);
  if (integer != number) return false;
  std::array<char, 16> digits;
  const auto end = std::to_chars(digits.begin(), digits.end(), integer).ptr;
  text.append(digits.begin(), end);
  return true;
}

}  // namespace

void append_number(double number, std::string& text) {
  if (append_small_integer(number, text)) return;
  if (!std::isfinite(number)) {
    text += std::isnan(number) ? "nan" : number < 0 ? "-inf" : "inf";
    return;
  }
  char buffer[128];
  double_conversion::StringBuilder builder(buffer, sizeof buffer);
  converter().ToPrecision(number, kDigits, &builder);
  const int length = builder.position();
  builder.Finalize();
  append_trimmed({buffer, static_cast<std::size_t>(length)}, text);
}

void append_stream_number(double number, std::string& text) {
  if (!(number == 0 && std::signbit(number)) &&
      append_small_integer(number, text)) {
    return;
  }
  // As printf's %g.
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.begin(), digits.end(), number,
                                 std::chars_format::general, kDigits)
                       .ptr;
  text.append(digits.begin(), end);
}

bool is_control(std::uint32_t code_point) {
  return code_point < 0x20 || (code_point >= 0x7F && code_point < 0xA0) ||
         code_point == 0x061C ||                            // direction
         (code_point >= 0x200E && code_point <= 0x200F) ||  // the same
         (code_point >= 0x2028 && code_point <= 0x202E) ||  // and separators
         (code_point >= 0x2066 && code_point <= 0x2069);
}

namespace {

// is_kept  controls that stay
template <typename IsKept>
std::string visible(std::string_view text, const IsKept& is_kept) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::uint32_t code = length == 0 ? 0 : first_code_point(text);
    if (length == 0) {
      result += "\uFFFD";
    } else if (is_control(code) && !is_kept(code)) {
      result += fmt::format("\\u{:04X}", code);
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

}  // namespace

std::string without_controls(std::string_view text) {
  return visible(
      text, [](std::uint32_t code) { return code == '\n' || code == '\t'; });
}

std::string message_text(std::string_view message) {
  std::string text;
  for (const char c : without_controls(message)) {
    text += c;
    if (c == '\n') text += "| ";
  }
  return text;
}

std::string on_one_line(std::string_view text) {
  std::string line =
      visible(text, [](std::uint32_t code) { return code == '\t'; });
  std::replace(line.begin(), line.end(), '\t', ' ');
  return line;
}

std::string short_name(std::string_view name) {
  constexpr std::size_t kMost = 100;
  constexpr std::size_t kMostBytes = 4 * kMost;  // of its characters
  const bool is_cut = name.size() > kMostBytes;
  std::string line = on_one_line(name.substr(0, kMostBytes));
  std::size_t end = 0;
  for (std::size_t i = 0; i < kMost && end < line.size(); ++i) {
    end += utf8_length(line[end]);
  }
  if (end >= line.size() && !is_cut) return line;
  return line.substr(0, end) + "…";
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const char byte = i + j < bytes.size() ? bytes[i + j] : '\0';
      bits = bits << 8 | static_cast<unsigned char>(byte);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * j) & 63];
    }
  }
  return text;
}

std::string escape_html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

std::string in_quotes(std::string_view content) {
  constexpr std::string_view kEscaped = "\t\n\r\"\\";
  constexpr std::string_view kLetters = "tnr\"\\";
  std::string text = "\"";
  for (const char c : content) {
    const std::size_t escaped = kEscaped.find(c);
    if (escaped == std::string_view::npos) {
      text += c;
    } else {
      text += '\\';
      text += kLetters[escaped];
    }
  }
  return text + '"';
}

Vec3 in_hundredths(Vec3 place) {
  return glm::round(place * 100.0) / 100.0 + 0.0;
}

std::string place_text(Vec3 place) {
  place = in_hundredths(place);
  return fmt::format("{:.2f}, {:.2f}, {:.2f}", place.x, place.y, place.z);
}

std::optional<double> parse_number(std::string_view text) {
  const double_conversion::StringToDoubleConverter converter(
      double_conversion::StringToDoubleConverter::NO_FLAGS, NAN, NAN, nullptr,
      nullptr);
  int used = 0;
  const double value = converter.StringToDouble(
      text.data(), static_cast<int>(text.size()), &used);
  if (text.empty() || used != static_cast<int>(text.size()) ||
      !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string counted(std::uint64_t count, std::string_view one,
                    std::string_view more) {
  if (count == 1) return fmt::format("1 {}", one);
  return more.empty() ? fmt::format("{} {}s", count, one)
                      : fmt::format("{} {}", count, more);
}

}  // namespace lamina
