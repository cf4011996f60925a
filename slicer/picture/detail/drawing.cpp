#include "slicer/picture/detail/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

constexpr Rgb kSolid = {0.85F, 0.66F, 0.25F};
constexpr Rgb kOutline = {0.36F, 0.25F, 0.06F};
constexpr Rgb kSupport = {0.56F, 0.65F, 0.75F};
constexpr Rgb kSupportOutline = {0.20F, 0.29F, 0.39F};

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

struct LayerColors {
  Rgb solid;
  Rgb outline;
};

void draw_contours(Image& image, const plane::Contours& contours,
                   const Rectangle& area, const PixelMap& map,
                   double outline_width, const LayerColors& colors) {
  Coverage solid(area.width, area.height);
  add_contours(solid, contours, map);
  blend(image, solid, area.x, area.y, colors.solid);

  Coverage outline(area.width, area.height);
  visit_edges(contours, [&](Vec2 from, Vec2 to) {
    outline.add_stroke(map(from), map(to), outline_width);
  });
  blend(image, outline, area.x, area.y, colors.outline);
}

}  // namespace

Box2 bounds_of(const std::vector<Layer>& layers) {
  Box2 box;
  for (const Layer& layer : layers) box.add(layer.contours.points);
  return box;
}

void fill(Image& image, const Rectangle& area, Rgb color) {
  for (unsigned y = area.y; y < area.y + area.height; ++y) {
    for (unsigned x = area.x; x < area.x + area.width; ++x) {
      image.at(x, y) = color;
    }
  }
}

void draw_tile(Image& image, const Rectangle& area) {
  fill(image, {area.x - 1, area.y - 1, area.width + 2, area.height + 2},
       kFrame);
  fill(image, area, kTile);
}

void blend(Image& image, const Coverage& coverage, unsigned x0, unsigned y0,
           Rgb color) {
  std::vector<float> shares;
  for (unsigned y = 0; y < coverage.height(); ++y) {
    coverage.resolve_row(y, shares);
    for (unsigned x = 0; x < coverage.width(); ++x) {
      if (shares[x] == 0) continue;
      Rgb& pixel = image.at(x0 + x, y0 + y);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        pixel[channel] += shares[x] * (color[channel] - pixel[channel]);
      }
    }
  }
}

void draw_text(Image& image, std::string_view text, Vec2 at, double size,
               Rgb color) {
  const auto top = static_cast<unsigned>(std::max(0.0, at.y - 1.5 * size));
  const unsigned height =
      std::min(static_cast<unsigned>(2.2 * size) + 1, image.height - top);
  Coverage coverage(image.width, height);
  add_text(coverage, text, at - Vec2(0, top), size);
  blend(image, coverage, 0, top, color);
}

double fitting_size(std::string_view text, double size, double room) {
  return std::min(size, size * std::max(room, 0.0) / text_width(text, size));
}

PixelMap fit(const Box2& bounds, const Rectangle& area, double padding) {
  const Vec2 room(area.width - 2 * padding, area.height - 2 * padding);
  const Vec2 size = bounds.size();
  const double scale = std::min(room.x / std::max(size.x, 1e-9),
                                room.y / std::max(size.y, 1e-9));
  PixelMap map{Vec2(0), {scale, 0}, {0, -scale}};
  map.origin = Vec2(area.width, area.height) / 2.0 - map(bounds.center());
  return map;
}

double round_length(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= longest) return digit * power;
  }
  return power;
}

double draw_scale(Image& image, Vec2 at, double longest, double pixels_per_mm,
                  double size) {
  const double length = round_length(longest / pixels_per_mm);
  const Vec2 to = at + Vec2(length * pixels_per_mm, 0);
  Coverage bar(image.width, image.height);
  bar.add_stroke(at, to, 3);
  for (const Vec2& end : {at, to}) {
    bar.add_stroke(end - Vec2(0, 6), end + Vec2(0, 6), 2);
  }
  blend(image, bar, 0, 0, kInk);
  const std::string words = fmt::format("{:g} mm", length);
  draw_text(image, words, to + Vec2(14, size / 2), size);
  return to.x + 14 + text_width(words, size);
}

void draw_layer(Image& image, const Layer& layer, const Rectangle& area,
                const PixelMap& map, double outline_width) {
  const bool has_supports = !layer.supports.is_empty();
  // The part hides the tips that are in it.
  if (has_supports) {
    draw_contours(image, layer.supports, area, map, outline_width,
                  {kSupport, kSupportOutline});
  }
  draw_contours(image, has_supports ? layer.part : layer.contours, area, map,
                outline_width, {kSolid, kOutline});
}

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
