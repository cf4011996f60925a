#include "slicer/picture.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "slicer/coverage.h"
#include "slicer/lettering.h"
#include "slicer/relief.h"

namespace lamina::slicer {
namespace {

constexpr Rgb kPaper = {0.97F, 0.965F, 0.95F};
constexpr Rgb kTile = {1.0F, 1.0F, 0.995F};
constexpr Rgb kFrame = {0.86F, 0.85F, 0.82F};
constexpr Rgb kInk = {0.25F, 0.24F, 0.22F};
constexpr Rgb kSolid = {0.85F, 0.66F, 0.25F};
constexpr Rgb kOutline = {0.36F, 0.25F, 0.06F};

constexpr unsigned kMargin = 18;       // around tiles and the sheet [pixels]
constexpr double kTitleSize = 17;      // height of a capital [pixels]
constexpr double kLabelSize = 10;      // the same, under a tile
constexpr unsigned kTitleHeight = 62;  // of the strip at the top [pixels]
constexpr unsigned kLabelHeight = 26;  // of the strip under a tile [pixels]
constexpr unsigned kPadding = 12;      // between a tile's frame and its layer
constexpr double kOutlineWidth = 1.3;  // [pixels]

// Sheets are at most this much higher than wide.
constexpr double kTallest = 1.25;

struct Bounds {
  Vec2 low = Vec2(1e300);
  Vec2 high = Vec2(-1e300);

  void add(const ldni::Contours& contours) {
    for (const Vec2& p : contours.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  Vec2 size() const { return high - low; }
  Vec2 center() const { return (low + high) / 2.0; }
};

struct Rectangle {
  unsigned x = 0;
  unsigned y = 0;
  unsigned width = 0;
  unsigned height = 0;
};

void fill(Image& image, const Rectangle& area, Rgb color) {
  for (unsigned y = area.y; y < area.y + area.height; ++y) {
    for (unsigned x = area.x; x < area.x + area.width; ++x) {
      image.at(x, y) = color;
    }
  }
}

// Mixes `color` into the image where `coverage` says, its corner at (x, y).
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

void draw_text(Image& image, std::string_view text, Vec2 at, double size) {
  const auto top = static_cast<unsigned>(std::max(0.0, at.y - 1.5 * size));
  const unsigned height =
      std::min(static_cast<unsigned>(2.2 * size) + 1, image.height - top);
  Coverage coverage(image.width, height);
  add_text(coverage, text, at - Vec2(0, top), size);
  blend(image, coverage, 0, top, kInk);
}

// How a sheet is divided: all tiles alike, all layers to one scale.
struct Grid {
  unsigned columns = 1;
  unsigned rows = 1;
  unsigned tile_width = 1;
  unsigned tile_height = 1;  // without its label

  Grid(unsigned width, unsigned count, double aspect, unsigned column_count)
      : columns(column_count), rows((count + column_count - 1) / column_count) {
    tile_width = (width - kMargin) / columns - kMargin;
    tile_height = static_cast<unsigned>(
        std::clamp(tile_width / aspect, 60.0, 2.0 * tile_width));
  }
  unsigned height() const {
    return kTitleHeight + rows * (tile_height + kLabelHeight + kMargin);
  }
};

// The fewest columns (the largest tiles) that keep the sheet low enough.
Grid choose_grid(unsigned width, unsigned count, double aspect) {
  for (unsigned columns = 1; columns < count; ++columns) {
    const Grid grid(width, count, aspect, columns);
    if (grid.height() <= kTallest * width * 0.62) return grid;
    if (grid.tile_width < 120) return grid;
  }
  return {width, count, aspect, count};
}

// `count` layers evenly spread over the part, the first and the last included.
std::vector<std::size_t> choose_layers(std::size_t available,
                                       std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : i * (available - 1) / (count - 1));
  }
  return chosen;
}

void draw_layer(Image& image, const Layer& layer, const Rectangle& tile,
                const Bounds& bounds) {
  const Vec2 room(tile.width - 2.0 * kPadding, tile.height - 2.0 * kPadding);
  const Vec2 size = bounds.size();
  const double scale = std::min(room.x / std::max(size.x, 1e-9),
                                room.y / std::max(size.y, 1e-9));
  PixelMap map{Vec2(0), {scale, 0}, {0, -scale}};
  map.origin = Vec2(tile.width, tile.height) / 2.0 - map(bounds.center());
  Coverage solid(tile.width, tile.height);
  add_contours(solid, layer.contours, map);
  blend(image, solid, tile.x, tile.y, kSolid);

  Coverage outline(tile.width, tile.height);
  for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
    const auto loop = layer.contours.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      outline.add_stroke(map(loop[j]), map(loop[(j + 1) % loop.size()]),
                         kOutlineWidth);
    }
  }
  blend(image, outline, tile.x, tile.y, kOutline);
}

void draw_tile(Image& image, const Layer& layer, std::size_t number,
               const Rectangle& tile, const Bounds& bounds) {
  fill(image, {tile.x - 1, tile.y - 1, tile.width + 2, tile.height + 2},
       kFrame);
  fill(image, tile, kTile);
  draw_layer(image, layer, tile, bounds);
  draw_text(
      image, fmt::format("layer {}   z {:.3f} mm", number, layer.section_z),
      {tile.x + 1.0, tile.y + tile.height + kLabelHeight - 8.0}, kLabelSize);
}

void draw_title(Image& image, const std::string& title,
                const std::vector<Layer>& layers, const Bounds& bounds) {
  double size = kTitleSize;
  const std::string text =
      fmt::format("{}    {} layers    {:.2f} x {:.2f} x {:.2f} mm", title,
                  layers.size(), bounds.size().x, bounds.size().y,
                  layers.back().top - layers.front().bottom);
  const double room = image.width - 2.0 * kMargin;
  size = std::min(size, size * room / text_width(text, size));
  draw_text(image, text, {kMargin, 40}, size);
}

Image draw_sheet(const std::vector<Layer>& layers, const std::string& title,
                 const Bounds& bounds, const PictureOptions& options) {
  const auto available = static_cast<unsigned>(layers.size());
  const Vec2 size = bounds.size();
  const double aspect = std::clamp(size.x / std::max(size.y, 1e-9), 0.3, 4.0);
  const Grid grid = choose_grid(
      options.width, std::min(available, options.layer_count), aspect);
  // A row begun is a row filled.
  const std::vector<std::size_t> chosen =
      choose_layers(available, std::min(available, grid.columns * grid.rows));
  Image image(options.width, grid.height(), kPaper);
  draw_title(image, title, layers, bounds);
  for (unsigned i = 0; i < chosen.size(); ++i) {
    const unsigned column = i % grid.columns;
    const unsigned row = i / grid.columns;
    const Rectangle tile = {
        kMargin + column * (grid.tile_width + kMargin),
        kTitleHeight + row * (grid.tile_height + kLabelHeight + kMargin),
        grid.tile_width, grid.tile_height};
    draw_tile(image, layers[chosen[i]], chosen[i] + 1, tile, bounds);
  }
  return image;
}

}  // namespace

Image draw_picture(const std::vector<Layer>& layers, const std::string& title,
                   const PictureOptions& options) {
  if (options.style == PictureStyle::kStack) {
    return draw_relief(layers, options.width);
  }
  Bounds bounds;
  for (const Layer& layer : layers) bounds.add(layer.contours);
  return draw_sheet(layers, title, bounds, options);
}

}  // namespace lamina::slicer
