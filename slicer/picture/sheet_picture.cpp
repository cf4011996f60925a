#include "slicer/picture/sheet_picture.h"

#include <algorithm>

#include <fmt/format.h>

#include "slicer/picture/detail/drawing.h"

namespace lamina::slicer {
namespace {

constexpr double kLabelSize = 10;      // the same, under a tile
constexpr unsigned kTitleHeight = 62;  // of the strip at the top [pixels]
constexpr unsigned kLabelHeight = 26;  // of the strip under a tile [pixels]
constexpr double kTilePadding = 12;    // between a tile's frame and its layer
constexpr double kTileOutline = 1.3;   // [pixels]

// Sheets are at most this much higher than wide.
constexpr double kTallest = 0.78;
constexpr unsigned kNarrowestTile = 120;  // where there is a choice [pixels]

// How a sheet is divided into equal tiles.
struct SheetGrid {
  unsigned columns = 1;
  unsigned rows = 1;
  unsigned tile_width = 1;
  unsigned tile_height = 1;  // without its label

  SheetGrid(unsigned width, unsigned count, double aspect,
            unsigned column_count)
      : columns(column_count), rows((count + column_count - 1) / column_count) {
    tile_width = (width - kMargin) / columns - kMargin;
    tile_height = static_cast<unsigned>(
        std::clamp(tile_width / aspect, 60.0, 2.0 * tile_width));
  }
  unsigned height() const {
    return kTitleHeight + rows * (tile_height + kLabelHeight + kMargin);
  }
  // Returns the place of the i-th layer on the sheet.
  Rectangle tile(unsigned i) const {
    return {kMargin + i % columns * (tile_width + kMargin),
            kTitleHeight + i / columns * (tile_height + kLabelHeight + kMargin),
            tile_width, tile_height};
  }
};

// Chooses the fewest columns (the largest tiles) that keep the sheet low
// enough.
SheetGrid choose_grid(unsigned width, unsigned count, double aspect) {
  for (unsigned columns = 1; columns < count; ++columns) {
    const SheetGrid grid(width, count, aspect, columns);
    if (grid.height() <= kTallest * width) return grid;
    if (grid.tile_width < kNarrowestTile) return grid;
  }
  return {width, count, aspect, count};
}

// Returns `count` layers evenly spread over the part, with the first and the
// last.
std::vector<std::size_t> choose_layers(std::size_t available,
                                       std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? 0 : i * (available - 1) / (count - 1));
  }
  return chosen;
}

std::string long_label(const Layer& layer, std::size_t number) {
  return fmt::format("layer {}   z {:.3f} mm", number, layer.section_z);
}

std::string short_label(const Layer& layer, std::size_t number) {
  return fmt::format("{}  z {:.3f}", number, layer.section_z);
}

// The texts under the tiles, all in one form and size, and no wider than a
// tile.
class Labels {
 public:
  Labels(const std::vector<Layer>& layers,
         const std::vector<std::size_t>& chosen, double room)
      : layers_(layers) {
    if (size_of(chosen, room) < kLabelSize) {
      make_ = short_label;
      size_ = size_of(chosen, room);
    }
  }

  void draw(Image& image, std::size_t i, const Rectangle& tile) const {
    draw_text(image, make_(layers_[i], i + 1),
              {tile.x + 1.0, tile.y + tile.height + kLabelHeight - 8.0}, size_);
  }

 private:
  double size_of(const std::vector<std::size_t>& chosen, double room) const {
    double size = kLabelSize;
    for (const std::size_t i : chosen) {
      size = fitting_size(make_(layers_[i], i + 1), size, room);
    }
    return size;
  }

  const std::vector<Layer>& layers_;
  std::string (*make_)(const Layer& layer, std::size_t number) = long_label;
  double size_ = kLabelSize;
};

void draw_title(Image& image, const std::string& title,
                const std::vector<Layer>& layers, const Box2& bounds) {
  const std::string text =
      fmt::format("{}    {} layers    {:.2f} × {:.2f} × {:.2f} mm", title,
                  layers.size(), bounds.size().x, bounds.size().y,
                  layers.back().top - layers.front().bottom);
  draw_text(image, text, {kMargin, 40},
            fitting_size(text, kTitleSize, image.width - 2.0 * kMargin));
}

}  // namespace

Image draw_sheet(const std::vector<Layer>& layers, const std::string& title,
                 const SheetOptions& options) {
  const Box2 bounds = bounds_of(layers);
  const auto available = static_cast<unsigned>(layers.size());
  const Vec2 size = bounds.size();
  const double aspect = std::clamp(size.x / std::max(size.y, 1e-9), 0.3, 4.0);
  const SheetGrid grid = choose_grid(
      options.width, std::min(available, options.layer_count), aspect);
  // Fill the last row, too.
  const std::vector<std::size_t> chosen =
      choose_layers(available, std::min(available, grid.columns * grid.rows));
  const Labels labels(layers, chosen, grid.tile_width);
  Image image(options.width, grid.height(), kPaper);
  draw_title(image, title, layers, bounds);
  for (unsigned i = 0; i < chosen.size(); ++i) {
    const Rectangle tile = grid.tile(i);
    draw_tile(image, tile);
    draw_layer(image, layers[chosen[i]], tile, fit(bounds, tile, kTilePadding),
               kTileOutline);
    labels.draw(image, chosen[i], tile);
  }
  return image;
}

}  // namespace lamina::slicer
