#include "slicer/picture/layer_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "slicer/check/thin/thin_features.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/picture/detail/drawing.h"

namespace lamina::slicer {
namespace {

constexpr unsigned kTopStrip = 78;   // of title and measures [pixels]
constexpr unsigned kFootStrip = 46;  // of the scale [pixels]
constexpr double kMostPadding = 48;  // between the frame and the layer [pixels]
constexpr double kPaddingShare = 0.1;  // of the frame's width, at most
constexpr double kLayerOutline = 1.8;  // [pixels]
constexpr double kMarkWidth = 4;       // of thin places [pixels]
constexpr double kRingRadius = 9;      // around the thinnest places [pixels]

constexpr Rgb kGridLine = {0.94F, 0.935F, 0.92F};
constexpr Rgb kWall = {0.80F, 0.10F, 0.12F};
constexpr Rgb kGap = {0.10F, 0.32F, 0.75F};

// Labels of thin places, the thinnest first: more would hide the layer.
constexpr std::size_t kMostLabels = 12;

// Returns the multiples of `step` within `reach` of `middle`. They are counted
// first: where numbers lie farther apart than steps, adding steps would never
// get anywhere.
std::vector<double> multiples(double step, double middle, double reach) {
  const double first = std::ceil((middle - reach) / step) * step;
  const int most = static_cast<int>(2 * reach / step) + 1;
  std::vector<double> found;
  for (int i = 0; i < most; ++i) {
    const double place = first + i * step;
    if (place < middle + reach) found.push_back(place);
  }
  return found;
}

class LayerPicture {
 public:
  LayerPicture(const std::vector<Layer>& layers, std::size_t index,
               const LayerPictureOptions& options)
      : layers_(layers),
        index_(index),
        layer_(layers[index]),
        options_(options),
        bounds_(choose_bounds()),
        field_(choose_field()),
        map_(fit(bounds_, field_, padding())),
        image_(options.width, kTopStrip + field_.height + kFootStrip, kPaper) {}

  Image draw(const std::string& title) {
    draw_words(title);
    draw_tile(image_, field_);
    draw_grid();
    draw_layer(image_, layer_, field_, map_, kLayerOutline);
    const double end =
        draw_scale(image_, {kMargin, image_.height - 20.0}, 0.25 * field_.width,
                   pixels_per_mm(), kTextSize);
    if (options_.min_feature > 0) mark_thin_places(end);
    return std::move(image_);
  }

 private:
  Box2 choose_bounds() const {
    if (layer_.contours.is_empty()) return bounds_of(layers_);
    Box2 bounds;
    bounds.add(layer_.contours.points);
    return bounds;
  }

  unsigned field_width() const { return options_.width - 2 * kMargin; }

  double padding() const {
    return std::min(kMostPadding, kPaddingShare * field_width());
  }

  Rectangle choose_field() const {
    const unsigned width = field_width();
    const Vec2 size = bounds_.size();
    const double height =
        (width - 2 * padding()) * size.y / std::max(size.x, 1e-9) +
        2 * padding();
    return {
        kMargin, kTopStrip, width,
        static_cast<unsigned>(std::clamp(height, 0.35 * width, 1.0 * width))};
  }

  double pixels_per_mm() const { return map_.per_x.x; }

  void draw_words(const std::string& title) {
    const double room = options_.width - 2.0 * kMargin;
    const std::string head =
        fmt::format("{}    layer {} of {}    z {:.6g} mm", title, index_ + 1,
                    layers_.size(), layer_.section_z);
    draw_text(image_, head, {kMargin, 34},
              fitting_size(head, kTitleSize, room));
    const LayerMeasures measures = measure(layer_.contours);
    const Vec2 size = measures.loops == 0 ? Vec2(0) : bounds_.size();
    const std::string words = fmt::format(
        "area {:.4f} mm²    loops {}, holes {}    perimeter {:.3f} mm    "
        "{:.2f} × {:.2f} mm",
        measures.area, measures.loops, measures.holes,
        total_perimeter(layer_.contours), size.x, size.y);
    draw_text(image_, words, {kMargin, 62},
              fitting_size(words, kTextSize, room));
  }

  // Draws lines at round distances, so that sizes can be judged at a glance.
  void draw_grid() {
    const double step = round_length(0.2 * field_.width / pixels_per_mm());
    Coverage lines(field_.width, field_.height);
    const Vec2 corner = bounds_.center();
    const double reach_x = field_.width / pixels_per_mm() / 2;
    const double reach_y = field_.height / pixels_per_mm() / 2;
    for (const double x : multiples(step, corner.x, reach_x)) {
      lines.add_stroke(map_({x, corner.y - reach_y}),
                       map_({x, corner.y + reach_y}), 1);
    }
    for (const double y : multiples(step, corner.y, reach_y)) {
      lines.add_stroke(map_({corner.x - reach_x, y}),
                       map_({corner.x + reach_x, y}), 1);
    }
    blend(image_, lines, field_.x, field_.y, kGridLine);
  }

  // from  where the summary may begin [pixels]
  void mark_thin_places(double from) {
    const double width = options_.min_feature;
    std::vector<ThinStretch> stretches;
    ThinFinder(width).find(layer_.contours, stretches);
    stroke(stretches, ThinKind::kWall, kWall);
    stroke(stretches, ThinKind::kGap, kGap);

    std::vector<ThinFeature> features = find_thin_features(layer_, width);
    std::ranges::sort(features, {}, &ThinFeature::width);
    const std::size_t count = std::min(features.size(), kMostLabels);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 place = map_(features[i].place);
      taken_.push_back({place - Vec2(kRingRadius), place + Vec2(kRingRadius)});
    }
    for (std::size_t i = 0; i < count; ++i) label(features[i]);
    const std::string words = summary(features);
    const double room = image_.width - kMargin - from - 40;
    const double size = fitting_size(words, kTextSize, room);
    draw_text(image_, words,
              {image_.width - kMargin - text_width(words, size),
               image_.height - 14.0},
              size, features.empty() ? kInk : kWall);
  }

  // Draws the middle lines.
  void stroke(const std::vector<ThinStretch>& stretches, ThinKind kind,
              Rgb color) {
    Coverage lines(field_.width, field_.height);
    for (const ThinStretch& stretch : stretches) {
      if (stretch.kind != kind) continue;
      lines.add_stroke(map_(stretch.from), map_(stretch.to), kMarkWidth);
    }
    blend(image_, lines, field_.x, field_.y, color);
  }

  // Draws a ring around the thinnest place, and the width beside it.
  void label(const ThinFeature& feature) {
    const Rgb color = feature.kind == ThinKind::kWall ? kWall : kGap;
    const Vec2 place = map_(feature.place);
    const std::string words = fmt::format("{:.3f}", feature.width);
    const Vec2 size(text_width(words, kTextSize) + 6, kTextSize + 8);
    const Box2 box = find_room(place, size);
    taken_.push_back(box);

    Coverage lines(field_.width, field_.height);
    constexpr int kCorners = 24;
    for (int i = 0; i < kCorners; ++i) {
      lines.add_stroke(place + kRingRadius * direction(i, kCorners),
                       place + kRingRadius * direction(i + 1, kCorners), 2);
    }
    const Vec2 middle = box.center();
    const Vec2 way = middle - place;
    const double length = glm::length(way);
    if (length > kRingRadius) {
      lines.add_stroke(place + way * (kRingRadius / length), middle, 1.2);
    }
    blend(image_, lines, field_.x, field_.y, color);

    const Vec2 corner = box.low + Vec2(field_.x, field_.y);
    fill(image_,
         {static_cast<unsigned>(corner.x), static_cast<unsigned>(corner.y),
          static_cast<unsigned>(size.x), static_cast<unsigned>(size.y)},
         kTile);
    draw_text(image_, words, corner + Vec2(3, kTextSize + 4), kTextSize, color);
  }

  static Vec2 direction(int i, int count) {
    const double angle = 2 * std::numbers::pi * i / count;
    return {std::cos(angle), -std::sin(angle)};
  }

  // Returns the nearest free room for a label around a place, or the first one
  // tried where all is taken.
  Box2 find_room(Vec2 place, Vec2 size) const {
    const Vec2 most = Vec2(field_.width, field_.height) - size;
    const auto box_at = [&](int way, double distance) {
      const Vec2 at = place + distance * direction(way, 16) - size / 2.0;
      const Vec2 low(std::clamp(at.x, 0.0, most.x),
                     std::clamp(at.y, 0.0, most.y));
      return Box2{low, low + size};
    };
    for (int ring = 0; ring < 12; ++ring) {
      for (int way = 0; way < 16; ++way) {
        const Box2 box = box_at(way, 44 + 18 * ring);
        const auto is_met = [&](const Box2& other) {
          return glm::all(glm::lessThan(box.low, other.high)) &&
                 glm::all(glm::lessThan(other.low, box.high));
        };
        if (std::ranges::none_of(taken_, is_met)) return box;
      }
    }
    return box_at(0, 44);
  }

  std::string summary(const std::vector<ThinFeature>& features) const {
    if (features.empty()) {
      return fmt::format("nothing thinner than {:g} mm", options_.min_feature);
    }
    const auto walls =
        std::ranges::count(features, ThinKind::kWall, &ThinFeature::kind);
    return fmt::format("thinner than {:g} mm: walls {}, gaps {}",
                       options_.min_feature, walls,
                       features.size() - static_cast<std::size_t>(walls));
  }

  const std::vector<Layer>& layers_;
  const std::size_t index_;
  const Layer& layer_;
  const LayerPictureOptions options_;
  const Box2 bounds_;
  const Rectangle field_;
  const PixelMap map_;
  Image image_;
  std::vector<Box2> taken_;  // by rings and labels; in the field [pixels]
};

}  // namespace

Image draw_layer_picture(const std::vector<Layer>& layers, std::size_t index,
                         const std::string& title,
                         const LayerPictureOptions& options) {
  return LayerPicture(layers, index, options).draw(title);
}

}  // namespace lamina::slicer
