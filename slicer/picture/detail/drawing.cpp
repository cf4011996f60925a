#include "slicer/picture/detail/drawing.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "slicer/contour/layer_edges.h"
#include "slicer/picture/detail/lettering.h"

namespace lamina::slicer {
namespace {

constexpr Rgb kSolid = {0.85F, 0.66F, 0.25F};
constexpr Rgb kOutline = {0.36F, 0.25F, 0.06F};

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

void draw_layer(Image& image, const ldni::Contours& contours,
                const Rectangle& area, const PixelMap& map,
                double outline_width) {
  Coverage solid(area.width, area.height);
  add_contours(solid, contours, map);
  blend(image, solid, area.x, area.y, kSolid);

  Coverage outline(area.width, area.height);
  visit_edges(contours, [&](Vec2 from, Vec2 to) {
    outline.add_stroke(map(from), map(to), outline_width);
  });
  blend(image, outline, area.x, area.y, kOutline);
}

}  // namespace lamina::slicer
