#include "slicer/picture/detail/lettering.h"

#include <array>

namespace lamina::slicer {
namespace {

// A glyph is a list of polylines, divided by '/'; a point is two characters:
// x from '0' to '8', y from 'a' (4 below the base line) over 'e' (on it) and
// 'm' (height of small letters) to 'q' (height of capitals).
struct Glyph {
  std::string_view letter;
  std::string_view strokes;
};

constexpr double kCapitalHeight = 12;
constexpr double kAdvance = 11.5;
constexpr double kThickness = 1.5;

constexpr auto kGlyphs = std::to_array<Glyph>({
    {"0", "2e6e8g8o6q2q0o0g2e"},
    {"1", "1n4q4e/1e7e"},
    {"2", "0o2q6q8o8m0e8e"},
    {"3", "0o2q6q8o8m6k3k/6k8i8g6e2e0g"},
    {"4", "6e6q0h8h"},
    {"5", "8q1q0k2l6l8j8g6e2e0g"},
    {"6", "7q4q1n0k0g2e6e8g8i6k2k0i"},
    {"7", "0q8q3e"},
    {"8", "2k0m0o2q6q8o8m6k2k0i0g2e6e8g8i6k"},
    {"9", "1e4e7h8k8o6q2q0o0m2k6k8m"},
    {".", "4e4f"},
    {",", "4f3c"},
    {":", "4f4g/4l4m"},
    {"-", "1k7k"},
    {"_", "0d8d"},
    {"/", "0c8r"},
    {"(", "6r4o4g6c"},
    {")", "2r4o4g2c"},
    {"+", "1k7k/4h4n"},
    {"=", "1i7i/1m7m"},
    {"%", "0e8q/1q1n4n4q1q/4h4e7e7h4h"},
    {"×", "1g7m/1m7g"},
    {"²", "0p1q3q4p4o0k4k"},
    {"³", "0q4q2o3o4n4l3k1k0l"},
    {"a", "1m5m7k7e/7i2i0h0f2e5e7g"},
    {"b", "0q0e/0g2e5e7g7k5m2m0k"},
    {"c", "7l5m2m0k0g2e5e7f"},
    {"d", "7q7e/7g5e2e0g0k2m5m7k"},
    {"e", "0i7i7k5m2m0k0g2e6e"},
    {"f", "6q4q2o2e/0m5m"},
    {"g", "7m7c5a1a/7g5e2e0g0k2m5m7k"},
    {"h", "0q0e/0k2m5m7k7e"},
    {"i", "4m4e/4p4q"},
    {"j", "5m5c3a1a/5p5q"},
    {"k", "0q0e/6m0h/2i7e"},
    {"l", "3q3f4e6e"},
    {"m", "0m0e/0k1m3m4k4e/4k5m7m8k8e"},
    {"n", "0m0e/0k2m5m7k7e"},
    {"o", "2m5m7k7g5e2e0g0k2m"},
    {"p", "0m0a/0g2e5e7g7k5m2m0k"},
    {"q", "7m7a/7g5e2e0g0k2m5m7k"},
    {"r", "1m1e/1j3m6m"},
    {"s", "7l5m2m0l0k1j6h7g6e2e0f"},
    {"t", "3q3g4e6e/0m6m"},
    {"u", "0m0g2e5e7g/7m7e"},
    {"v", "0m4e8m"},
    {"w", "0m2e4k6e8m"},
    {"x", "0m7e/7m0e"},
    {"y", "0m4e/8m2a"},
    {"z", "0m7m0e7e"},
    {"A", "0e4q8e/1i7i"},
    {"B", "0e0q5q7o7m5k0k/5k8i8g6e0e"},
    {"C", "8o6q2q0o0g2e6e8g"},
    {"D", "0e0q5q8n8h5e0e"},
    {"E", "8q0q0e8e/0k6k"},
    {"F", "8q0q0e/0k6k"},
    {"G", "8o6q2q0o0g2e6e8g8j5j"},
    {"H", "0q0e/8q8e/0k8k"},
    {"I", "4q4e/2q6q/2e6e"},
    {"J", "6q6g4e2e0g"},
    {"K", "0q0e/8q0j/2k8e"},
    {"L", "0q0e8e"},
    {"M", "0e0q4j8q8e"},
    {"N", "0e0q8e8q"},
    {"O", "2e6e8g8o6q2q0o0g2e"},
    {"P", "0e0q6q8o8m6k0k"},
    {"Q", "2e6e8g8o6q2q0o0g2e/5h8d"},
    {"R", "0e0q6q8o8m6k0k/4k8e"},
    {"S", "8o6q2q0o0m2k6k8i8g6e2e0g"},
    {"T", "0q8q/4q4e"},
    {"U", "0q0g2e6e8g8q"},
    {"V", "0q4e8q"},
    {"W", "0q2e4m6e8q"},
    {"X", "0q8e/8q0e"},
    {"Y", "0q4k8q/4k4e"},
    {"Z", "0q8q0e8e"},
    {" ", ""},
});
constexpr std::string_view kUnknown = "1e7e7m1m1e";

std::string_view strokes_of(std::string_view letter) {
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.letter == letter) return glyph.strokes;
  }
  return kUnknown;
}

// Cuts the first character, of UTF-8, off the text.
std::string_view take_letter(std::string_view& text) {
  std::size_t length = 1;
  while (length < text.size() && (text[length] & 0xC0) == 0x80) ++length;
  const std::string_view letter = text.substr(0, length);
  text.remove_prefix(length);
  return letter;
}

}  // namespace

void add_text(Coverage& coverage, std::string_view text, Vec2 at, double size) {
  const double unit = size / kCapitalHeight;
  while (!text.empty()) {
    std::string_view strokes = strokes_of(take_letter(text));
    while (!strokes.empty()) {
      const std::string_view line = strokes.substr(0, strokes.find('/'));
      const auto point = [&](std::size_t i) {
        return at + unit * Vec2(line[i] - '0', 'e' - line[i + 1]);
      };
      for (std::size_t i = 2; i + 1 < line.size(); i += 2) {
        coverage.add_stroke(point(i - 2), point(i), kThickness * unit);
      }
      strokes.remove_prefix(std::min(line.size() + 1, strokes.size()));
    }
    at.x += kAdvance * unit;
  }
}

double text_width(std::string_view text, double size) {
  std::size_t letters = 0;
  while (!text.empty()) {
    take_letter(text);
    ++letters;
  }
  return static_cast<double>(letters) * kAdvance * size / kCapitalHeight;
}

}  // namespace lamina::slicer
