#include "slicer/picture/difference_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "plane/loop_area.h"
#include "plane/region/boolean.h"
#include "plane/region/region.h"
#include "slicer/picture/detail/drawing.h"

namespace lamina::slicer {
namespace {

constexpr unsigned kFieldSize = 680;           // of both fields [pixels]
constexpr unsigned kDifferenceTopStrip = 84;   // of title and numbers [pixels]
constexpr unsigned kDifferenceFootStrip = 84;  // of scales and legend [pixels]
constexpr double kDifferenceTitleSize = 16;    // height of a capital [pixels]
constexpr double kDifferencePadding =
    30;  // between a frame and the layer [pixels]
constexpr double kDifferenceOutline = 1.5;  // [pixels]
// Differences thinner than this are left to the magnified field [pixels].
constexpr double kLeastSeen = 0.02;

constexpr Rgb kBoth = {0.83F, 0.82F, 0.78F};
constexpr Rgb kOnlyA = {0.13F, 0.39F, 0.78F};
constexpr Rgb kOnlyB = {0.87F, 0.33F, 0.08F};
constexpr Rgb kMark = {0.25F, 0.24F, 0.22F};

// The magnified field shows this many times the greatest distance, but at least
// a tie distance of solids [mm].
constexpr double kDistancesShown = 6;
constexpr double kLeastShown = 1e-6;

plane::Region region_of(const plane::Contours& contours) {
  return plane::from_contours(plane::to_region(contours).contours,
                              plane::FillRule::kNonZero);
}

class DifferencePicture {
 public:
  DifferencePicture(const plane::Contours& a, const plane::Contours& b,
                    const LayerDifference& difference)
      : difference_(difference),
        image_(2 * kFieldSize + 3 * kMargin,
               kDifferenceTopStrip + kFieldSize + kDifferenceFootStrip,
               kPaper) {
    const std::array regions = {region_of(a), region_of(b)};
    const std::array turned = {regions[1], regions[0]};
    both_ = to_contours(plane::intersect(regions));
    only_a_ = to_contours(plane::subtract(regions));
    only_b_ = to_contours(plane::subtract(turned));
    bounds_.add(a.points);
    bounds_.add(b.points);
    if (a.points.empty() && b.points.empty()) bounds_ = around({0, 0}, 1);
  }

  Image draw(const std::array<std::string, 2>& names) {
    const Rectangle whole = {kMargin, kDifferenceTopStrip, kFieldSize,
                             kFieldSize};
    const Rectangle detail = {2 * kMargin + kFieldSize, kDifferenceTopStrip,
                              kFieldSize, kFieldSize};
    draw_words();
    const PixelMap map = fit(bounds_, whole, kDifferencePadding);
    draw_field(whole, map);
    const Box2 window = detail_bounds();
    mark(whole, map, window);
    draw_field(detail, fit(window, detail, 0));
    draw_legend(names);
    return std::move(image_);
  }

 private:
  static Box2 around(Vec2 middle, double size) {
    return {middle - Vec2(size / 2), middle + Vec2(size / 2)};
  }

  Box2 detail_bounds() const {
    const Vec2 size = bounds_.size();
    const double largest = std::max({size.x, size.y, kLeastShown});
    const double distance = difference_.distance.distance;
    const double wanted =
        std::isinf(distance) ? largest / 4 : kDistancesShown * distance;
    // Where nothing differs there is nothing to magnify.
    if (distance == 0) return bounds_;
    return around(difference_.distance.place,
                  std::clamp(wanted, kLeastShown, largest));
  }

  void draw_words() {
    const double room = image_.width - 2.0 * kMargin;
    const std::string head = fmt::format("layer {}    z {:.6g} mm",
                                         difference_.number, difference_.z);
    draw_text(image_, head, {kMargin, 36}, kDifferenceTitleSize);
    const double distance = difference_.distance.distance;
    const std::string words = fmt::format(
        "only a {:.6f} mm²    only b {:.6f} mm²    {}",
        difference_.areas.only_a, difference_.areas.only_b,
        std::isinf(distance)
            ? "only one of them has contours"
            : fmt::format("distance {:.3g} mm near x {:.6g} y {:.6g}", distance,
                          difference_.distance.place.x,
                          difference_.distance.place.y));
    draw_text(image_, words, {kMargin, 66},
              fitting_size(words, kTextSize, room));
  }

  // Draws a field with its scale below it.
  void draw_field(const Rectangle& field, const PixelMap& map) {
    draw_tile(image_, field);
    solid(field, map, both_, kBoth);
    outline(field, map, both_, kMark, 0);
    solid(field, map, only_a_, kOnlyA);
    solid(field, map, only_b_, kOnlyB);
    // Outline them too: what is thinner than a pixel would hardly be seen.
    outline(field, map, only_a_, kOnlyA, kLeastSeen);
    outline(field, map, only_b_, kOnlyB, kLeastSeen);
    draw_scale(image_, {field.x + 2.0, field.y + field.height + 24.0},
               0.3 * field.width, map.per_x.x, kTextSize);
  }

  void solid(const Rectangle& field, const PixelMap& map,
             const plane::Contours& contours, Rgb color) {
    Coverage coverage(field.width, field.height);
    add_contours(coverage, contours, map);
    blend(image_, coverage, field.x, field.y, color);
  }

  // Outlines loops whose mean width is at least `least` pixels.
  void outline(const Rectangle& field, const PixelMap& map,
               const plane::Contours& contours, Rgb color, double least) {
    Coverage lines(field.width, field.height);
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      const double width =
          2 * std::abs(signed_area(loop)) * map.per_x.x / perimeter(loop);
      if (width < least) continue;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        stroke_inside(lines, map(loop[k]), map(loop[(k + 1) % loop.size()]));
      }
    }
    blend(image_, lines, field.x, field.y, color);
  }

  // Draws the part of a line within the field: magnified, ends can be
  // kilometres away.
  static void stroke_inside(Coverage& lines, Vec2 from, Vec2 to) {
    const Vec2 low(-10);
    const Vec2 high(lines.width() + 10, lines.height() + 10);
    double begin = 0;
    double end = 1;
    for (int axis = 0; axis < 2; ++axis) {
      const double step = to[axis] - from[axis];
      if (step == 0) {
        if (from[axis] < low[axis] || from[axis] > high[axis]) return;
        continue;
      }
      const double p = (low[axis] - from[axis]) / step;
      const double q = (high[axis] - from[axis]) / step;
      begin = std::max(begin, std::min(p, q));
      end = std::min(end, std::max(p, q));
    }
    if (begin >= end) return;
    lines.add_stroke(from + begin * (to - from), from + end * (to - from),
                     kDifferenceOutline);
  }

  // Draws a frame around what the other field shows.
  void mark(const Rectangle& field, const PixelMap& map, const Box2& window) {
    constexpr double kLeastFrame = 16;  // pixels
    const Vec2 middle = map(window.center());
    const double half =
        std::max(window.size().x * map.per_x.x, kLeastFrame) / 2;
    Coverage lines(field.width, field.height);
    const std::array<Vec2, 4> corners = {
        middle + Vec2(-half, -half), middle + Vec2(half, -half),
        middle + Vec2(half, half), middle + Vec2(-half, half)};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      stroke_inside(lines, corners[i], corners[(i + 1) % corners.size()]);
    }
    blend(image_, lines, field.x, field.y, kMark);
  }

  void draw_legend(const std::array<std::string, 2>& names) {
    struct Entry {
      Rgb color;
      std::string words;
    };
    const std::array<Entry, 3> entries = {{{kBoth, "both"},
                                           {kOnlyA, "only a: " + names[0]},
                                           {kOnlyB, "only b: " + names[1]}}};
    const double y = image_.height - 18.0;
    std::string all;
    for (const Entry& entry : entries) all += entry.words;
    constexpr double kSwatch = 18;  // pixels
    constexpr double kGap = 34;     // pixels
    const double room =
        image_.width - 2.0 * kMargin - entries.size() * (kSwatch + 8 + kGap);
    const double size = fitting_size(all, kTextSize, room);
    double x = kMargin;
    for (const Entry& entry : entries) {
      fill(image_,
           {static_cast<unsigned>(x), static_cast<unsigned>(y - 13),
            static_cast<unsigned>(kSwatch), 14},
           entry.color);
      draw_text(image_, entry.words, {x + kSwatch + 8, y}, size);
      x += kSwatch + 8 + text_width(entry.words, size) + kGap;
    }
  }

  const LayerDifference& difference_;
  Image image_;
  plane::Contours both_;
  plane::Contours only_a_;
  plane::Contours only_b_;
  Box2 bounds_;
};

}  // namespace

Image draw_difference(const plane::Contours& a, const plane::Contours& b,
                      const LayerDifference& difference,
                      const std::array<std::string, 2>& names) {
  return DifferencePicture(a, b, difference).draw(names);
}

}  // namespace lamina::slicer
