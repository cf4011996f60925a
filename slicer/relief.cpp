#include "slicer/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <oneapi/tbb/parallel_for.h>

#include "csg/vec.h"

namespace lamina::slicer {
namespace {

namespace tbb = oneapi::tbb;

// The viewer stands right in front of the part and looks down on it.
constexpr double kAzimuth = -0.62;   // [rad] turn of the part
constexpr double kElevation = 0.62;  // [rad] above the horizon

constexpr unsigned kOversampling = 2;  // in x and in y
constexpr double kMargin = 0.06;       // of the picture's width
constexpr double kShadeReach = 0.035;  // the same: how far walls take light
constexpr float kNothing = -std::numeric_limits<float>::infinity();

// Seen along the line of sight: right, away from the viewer along the ground,
// up.
struct View {
  double cos_azimuth = std::cos(kAzimuth);
  double sin_azimuth = std::sin(kAzimuth);
  double cos_elevation = std::cos(kElevation);
  double sin_elevation = std::sin(kElevation);

  // Of a place on the ground: right and up in the picture.
  Vec2 operator()(Vec2 p) const {
    return {p.x * cos_azimuth - p.y * sin_azimuth,
            (p.x * sin_azimuth + p.y * cos_azimuth) * sin_elevation};
  }
  double up(double z) const { return z * cos_elevation; }
};

// Heights of the surface seen in each pixel, in pixels of the oversampled
// picture; y down.
class HeightPicture {
 public:
  HeightPicture(unsigned width, unsigned height)
      : width_(width),
        height_(height),
        heights_(std::size_t{width} * height, kNothing),
        next_free_(std::size_t{width + 1} * height) {
    for (unsigned y = 0; y < height; ++y) {
      std::iota(free_row(y), free_row(y) + width + 1, 0U);
    }
  }

  unsigned width() const { return width_; }
  unsigned height() const { return height_; }
  float at(int x, int y) const {
    if (x < 0 || y < 0 || x >= static_cast<int>(width_) ||
        y >= static_cast<int>(height_)) {
      return kNothing;
    }
    return heights_[static_cast<std::size_t>(y) * width_ +
                    static_cast<std::size_t>(x)];
  }

  // Gives the free pixels whose middle lies in [x0, x1) of row y a height.
  void fill(unsigned y, double x0, double x1, float height) {
    const double limit = width_;
    const auto begin =
        static_cast<unsigned>(std::clamp(std::ceil(x0 - 0.5), 0.0, limit));
    const auto end =
        static_cast<unsigned>(std::clamp(std::ceil(x1 - 0.5), 0.0, limit));
    unsigned* const next = free_row(y);
    for (unsigned x = find_free(next, begin); x < end; x = find_free(next, x)) {
      heights_[std::size_t{y} * width_ + x] = height;
      next[x] = x + 1;
    }
  }

 private:
  unsigned* free_row(unsigned y) {
    return next_free_.data() + std::size_t{y} * (width_ + 1);
  }
  static unsigned find_free(unsigned* next, unsigned x) {
    while (next[x] != x) x = next[x] = next[next[x]];
    return x;
  }

  unsigned width_;
  unsigned height_;
  std::vector<float> heights_;
  std::vector<unsigned> next_free_;  // itself where free; one more a row
};

// Fills the contours row by row: where the winding number is not 0.
class LayerFiller {
 public:
  explicit LayerFiller(HeightPicture& picture)
      : picture_(picture), crossings_(picture.height()) {}

  // corners  of all loops in the picture; ends as in Contours
  // shift    added to their y
  void fill(std::span<const Vec2> corners, std::span<const std::uint32_t> ends,
            double shift, float height) {
    std::size_t begin = 0;
    for (const std::uint32_t end : ends) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec2& to = corners[i + 1 == end ? begin : i + 1];
        add_edge(corners[i] + Vec2(0, shift), to + Vec2(0, shift));
      }
      begin = end;
    }
    for (unsigned y = first_row_; y < last_row_; ++y) fill_row(y, height);
    first_row_ = picture_.height();
    last_row_ = 0;
  }

 private:
  struct Crossing {
    double x;
    int winding;
  };

  void add_edge(Vec2 from, Vec2 to) {
    const int winding = from.y < to.y ? 1 : -1;
    const Vec2 top = from.y < to.y ? from : to;
    const Vec2 bottom = from.y < to.y ? to : from;
    const double limit = picture_.height();
    const auto begin =
        static_cast<unsigned>(std::clamp(std::ceil(top.y - 0.5), 0.0, limit));
    const auto end = static_cast<unsigned>(
        std::clamp(std::ceil(bottom.y - 0.5), 0.0, limit));
    if (begin >= end) return;
    const double slope = (bottom.x - top.x) / (bottom.y - top.y);
    for (unsigned y = begin; y < end; ++y) {
      crossings_[y].push_back({top.x + slope * (y + 0.5 - top.y), winding});
    }
    first_row_ = std::min(first_row_, begin);
    last_row_ = std::max(last_row_, end);
  }

  void fill_row(unsigned y, float height) {
    std::vector<Crossing>& row = crossings_[y];
    std::sort(row.begin(), row.end(),
              [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    int winding = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      winding += row[i].winding;
      if (winding != 0) picture_.fill(y, row[i].x, row[i + 1].x, height);
    }
    row.clear();
  }

  HeightPicture& picture_;
  std::vector<std::vector<Crossing>> crossings_;  // of each row
  unsigned first_row_ = std::numeric_limits<unsigned>::max();
  unsigned last_row_ = 0;
};

// Where the stack lies in the picture.
struct Frame {
  double scale = 1;  // oversampled pixels per mm
  Vec2 shift = Vec2(0);
  double ground = 0;  // height of the lowest layer [mm]
  unsigned width = 1;
  unsigned height = 1;

  Vec2 operator()(Vec2 seen) const {
    return {shift.x + scale * seen.x, shift.y - scale * seen.y};
  }
};

Frame choose_frame(const std::vector<Layer>& layers, const View& view,
                   unsigned width) {
  Vec2 low(1e300);
  Vec2 high(-1e300);
  for (const Layer& layer : layers) {
    for (const Vec2& p : layer.contours.points) {
      const Vec2 seen = view(p);
      low = {std::min(low.x, seen.x),
             std::min(low.y, seen.y + view.up(layer.bottom))};
      high = {std::max(high.x, seen.x),
              std::max(high.y, seen.y + view.up(layer.top))};
    }
  }
  const Vec2 size = high - low;
  Frame frame;
  frame.width = width;
  const double margin = kMargin * width;
  // As wide as the picture, but no higher than it is wide.
  frame.scale = (width - 2 * margin) / std::max({size.x, size.y, 1e-9});
  frame.height =
      static_cast<unsigned>(std::ceil(frame.scale * size.y + 2 * margin));
  frame.shift = {(width - frame.scale * (low.x + high.x)) / 2,
                 margin + frame.scale * high.y};
  frame.ground = layers.front().bottom;
  return frame;
}

HeightPicture draw_heights(const std::vector<Layer>& layers, const View& view,
                           const Frame& frame) {
  HeightPicture picture(frame.width, frame.height);
  LayerFiller filler(picture);
  std::vector<Vec2> corners;
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    if (layer->contours.is_empty()) continue;
    corners.clear();
    for (const Vec2& p : layer->contours.points) {
      corners.push_back(frame(view(p)));
    }
    const double thickness = layer->top - layer->bottom;
    const int steps = static_cast<int>(std::clamp(
        1 + frame.scale * view.up(thickness), 1.0, 1.0 + frame.height));
    for (int step = 0; step < steps; ++step) {
      const double z = layer->top - thickness * step / steps;
      filler.fill(corners, layer->contours.ends, -frame.scale * view.up(z),
                  static_cast<float>((z - frame.ground) * frame.scale));
    }
  }
  return picture;
}

// Slopes of the heights: a plane fitted to the neighbours that belong to the
// same surface.
Vec2 slope_at(const HeightPicture& picture, int x, int y, int radius) {
  const float center = picture.at(x, y);
  double xx = 0;
  double xy = 0;
  double yy = 0;
  double xz = 0;
  double yz = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const double dz = picture.at(x + dx, y + dy) - center;
      const double distance = std::abs(dx) + std::abs(dy);
      // A wall rises by 1 / cos(elevation) a pixel; a step is more.
      if (!(std::abs(dz) <= 1.6 * distance + 1)) continue;
      xx += dx * dx;
      xy += dx * dy;
      yy += dy * dy;
      xz += dx * dz;
      yz += dy * dz;
    }
  }
  const double determinant = xx * yy - xy * xy;
  if (determinant < 1) return Vec2(0);
  return {(xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant};
}

// The surface normal in the viewer's frame: right, away, up.
Vec3 normal_at(const HeightPicture& picture, int x, int y, int radius,
               const View& view) {
  const Vec2 slope = slope_at(picture, x, y, radius);
  // A pixel (u, v up) of height z shows the place (u, (v - z cos e) / sin e,
  // z); this is the cross product of that place's derivatives.
  const double zu = slope.x;
  const double zv = -slope.y;
  Vec3 normal(-zu, -zv * view.sin_elevation, 1 - zv * view.cos_elevation);
  normal.z = std::max(normal.z, 0.0);
  const double length = std::sqrt(normal.x * normal.x + normal.y * normal.y +
                                  normal.z * normal.z);
  return length > 0 ? normal / length : Vec3(0, 0, 1);
}

// Where to look for what takes the sky from a pixel: places around it, in
// directions of their own, near ones more often.
class Openness {
 public:
  // reach  of the farthest place [pixels]
  Openness(const View& view, double reach) : view_(view), reach_(reach) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * 3.14159265358979 * (i + 0.5) / kDirections;
      for (int step = 1; step <= kSteps; ++step) {
        const double distance = reach * step * step / (kSteps * kSteps);
        places_[static_cast<std::size_t>(i) * kSteps +
                static_cast<std::size_t>(step) - 1] = {
            static_cast<int>(std::lround(distance * std::cos(angle))),
            static_cast<int>(std::lround(distance * std::sin(angle)))};
      }
    }
  }

  // The open share of the sky, 0 … 1.
  double at(const HeightPicture& picture, int x, int y) const {
    const float center = picture.at(x, y);
    double open = 0;
    for (int i = 0; i < kDirections; ++i) {
      double steepest = 0;
      for (int step = 0; step < kSteps; ++step) {
        const auto& [dx, dy] = places_[static_cast<std::size_t>(i) * kSteps +
                                       static_cast<std::size_t>(step)];
        const float height = picture.at(x + dx, y + dy);
        if (height <= center) continue;
        const double rise = height - center;
        const double away =
            (-dy - rise * view_.cos_elevation) / view_.sin_elevation;
        const double run = std::sqrt(dx * dx + away * away);
        // What is far off throws little shade.
        const double fading = std::max(0.0, 1 - run / (3 * reach_));
        steepest = std::max(steepest, fading * rise / std::max(run, 1.0));
      }
      open += 1 / std::sqrt(1 + steepest * steepest);
    }
    return open / kDirections;
  }

 private:
  static constexpr int kDirections = 12;
  static constexpr int kSteps = 4;
  View view_;
  double reach_;
  std::array<std::array<int, 2>, std::size_t{kDirections} * kSteps> places_{};
};

double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 unit(Vec3 v) { return v / std::sqrt(dot(v, v)); }

double to_srgb(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  return linear <= 0.0031308 ? 12.92 * linear
                             : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Polished gold: a key light from the upper left, a weak one from the right,
// and a room mirrored in it, dark below and bright above. In linear light.
Vec3 shade(Vec3 normal, double openness, const View& view) {
  const Vec3 gold(0.92, 0.58, 0.16);
  const Vec3 to_viewer(0, -view.cos_elevation, view.sin_elevation);
  const Vec3 key = unit(Vec3(-0.62, -0.35, 0.75));
  const Vec3 fill = unit(Vec3(0.85, -0.45, 0.25));
  const double open = openness * openness;
  const double diffuse = 0.55 * std::max(0.0, dot(normal, key)) +
                         0.12 * std::max(0.0, dot(normal, fill));
  const Vec3 mirrored = 2 * dot(normal, to_viewer) * normal - to_viewer;
  const double room = 0.06 + 0.34 * smooth_step(-0.55, 0.95, mirrored.z) +
                      0.10 * smooth_step(0.1, 0.9, -mirrored.x);
  const double shine = 0.5 * std::pow(std::max(0.0, dot(mirrored, key)), 14.0);
  return gold * (diffuse * (0.3 + 0.7 * open) + room * open) +
         Vec3(1.0, 0.88, 0.62) * (shine * open);
}

constexpr Rgb kBackgroundTop = {0.955F, 0.955F, 0.95F};
constexpr Rgb kBackgroundBottom = {0.86F, 0.865F, 0.87F};

Rgb background_at(double share) {
  Rgb color{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    color[channel] = kBackgroundTop[channel] +
                     static_cast<float>(share) *
                         (kBackgroundBottom[channel] - kBackgroundTop[channel]);
  }
  return color;
}

// The mean of the pixels of the oversampled picture that make up (x, y). The
// sky changes slowly: it is looked at once.
Rgb shade_pixel(const HeightPicture& picture, int x, int y, int radius,
                const Openness& openness, const View& view, Rgb background) {
  constexpr int kSide = kOversampling;
  double open = -1;
  Rgb sum{};
  for (int i = 0; i < kSide * kSide; ++i) {
    const int px = x * kSide + i % kSide;
    const int py = y * kSide + i / kSide;
    Rgb color = background;
    if (picture.at(px, py) != kNothing) {
      if (open < 0) open = openness.at(picture, px, py);
      const Vec3 light =
          shade(normal_at(picture, px, py, radius, view), open, view);
      color = {static_cast<float>(to_srgb(light.x)),
               static_cast<float>(to_srgb(light.y)),
               static_cast<float>(to_srgb(light.z))};
    }
    for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
  }
  for (float& channel : sum) channel /= kSide * kSide;
  return sum;
}

}  // namespace

Image draw_relief(const std::vector<Layer>& layers, unsigned width) {
  const View view;
  const Frame frame = choose_frame(layers, view, width * kOversampling);
  const HeightPicture picture = draw_heights(layers, view, frame);
  // Wide enough to span a layer's side, small enough to keep edges.
  const double layer_height =
      frame.scale * view.up(layers.back().top - layers.front().bottom) /
      static_cast<double>(layers.size());
  const int radius =
      std::clamp(static_cast<int>(std::lround(layer_height)), 2, 4);
  const Openness openness(view, kShadeReach * frame.width);

  Image image(width, frame.height / kOversampling, kBackgroundTop);
  tbb::parallel_for(0U, image.height, [&](unsigned y) {
    const Rgb background = background_at(static_cast<double>(y) / image.height);
    for (unsigned x = 0; x < image.width; ++x) {
      image.at(x, y) =
          shade_pixel(picture, static_cast<int>(x), static_cast<int>(y), radius,
                      openness, view, background);
    }
  });
  return image;
}

}  // namespace lamina::slicer
