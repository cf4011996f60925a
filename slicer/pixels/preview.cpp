#include "slicer/pixels/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "slicer/pixels/grey_runs.h"

namespace lamina::slicer {
namespace {

constexpr int kSide = 480;          // of the picture that is kept [pixels]
constexpr double kMargin = 24;      // around the part [pixels]
constexpr double kTurn = 0.55;      // of the part around z [rad]
constexpr double kElevation = 0.6;  // of the viewer [rad]
constexpr int kSmoothings = 4;      // of heights, whose steps are pixels
constexpr double kSameSurface = 3;  // steps between neighbours of one surface
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

constexpr Vec3 kSolid(0.78, 0.46, 0.11);  // linear light
constexpr Vec3 kBackground(0.014, 0.016, 0.02);

const double kCosTurn = std::cos(kTurn);
const double kSinTurn = std::sin(kTurn);
const double kCosElevation = std::cos(kElevation);
const double kSinElevation = std::sin(kElevation);

using Heights = std::vector<float>;

std::size_t index_of(int u, int v) {
  return static_cast<std::size_t>(v) * kSide + static_cast<std::size_t>(u);
}

// The height at a pixel if it is of the same surface as `z`, else `otherwise`.
float height_near(const Heights& heights, int u, int v, float z, double step,
                  float otherwise) {
  if (u < 0 || v < 0 || u >= kSide || v >= kSide) return otherwise;
  const float height = heights[index_of(u, v)];
  return std::abs(height - z) <= kSameSurface * step ? height : otherwise;
}

// Calls set(u, v, z) for the pixels that show something.
template <typename Set>
void for_each_pixel(const Heights& heights, const Set& set) {
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const float z = heights[index_of(u, v)];
      if (!std::isnan(z)) set(u, v, z);
    }
  }
}

// step  between heights that are drawn [mm]
Heights smooth(Heights heights, double step) {
  Heights smoothed = heights;
  for (int i = 0; i < kSmoothings; ++i) {
    for_each_pixel(heights, [&](int u, int v, float z) {
      float sum = 0;
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          sum += height_near(heights, u + du, v + dv, z, step, z);
        }
      }
      smoothed[index_of(u, v)] = sum / 9;
    });
    heights.swap(smoothed);
  }
  return heights;
}

// Where a pixel's line of sight meets a height, in the turned part [mm].
Vec3 place_of(double u, double v, double z, double scale) {
  return {u / scale, (-v / scale - z * kCosElevation) / kSinElevation, z};
}

Vec3 normal_at(const Heights& heights, int u, int v, double scale,
               double step) {
  const float z = heights[index_of(u, v)];
  const auto place = [&](int du, int dv) {
    const float near = height_near(heights, u + du, v + dv, z, step, kNothing);
    return std::isnan(near) ? place_of(u, v, z, scale)
                            : place_of(u + du, v + dv, near, scale);
  };
  const Vec3 normal =
      glm::cross(place(1, 0) - place(-1, 0), place(0, -1) - place(0, 1));
  const double length = glm::length(normal);
  return length > 0 ? normal / length : Vec3(0, 0, 1);
}

Vec3 light_on(Vec3 normal) {
  const Vec3 key = glm::normalize(Vec3(-0.62, -0.35, 0.75));
  const Vec3 viewer(0, -kCosElevation, kSinElevation);
  const double diffuse = 0.22 + 0.2 * std::max(0.0, normal.z) +
                         0.8 * std::max(0.0, glm::dot(normal, key));
  const Vec3 halfway = glm::normalize(key + viewer);
  const double shine =
      0.5 * std::pow(std::max(0.0, glm::dot(normal, halfway)), 24.0);
  return kSolid * diffuse + Vec3(shine);
}

std::uint8_t to_byte(double linear) {
  constexpr double kGamma = 2.2;
  return static_cast<std::uint8_t>(
      std::lround(255 * std::pow(std::clamp(linear, 0.0, 1.0), 1 / kGamma)));
}

}  // namespace

Preview::Preview(const Box3& box)
    : heights_(static_cast<std::size_t>(kSide) * kSide, kNothing) {
  if (box.is_empty()) return;
  // Right and up on the screen, of each direction of the part.
  const Vec2 x(kCosTurn, kSinTurn * kSinElevation);
  const Vec2 y(-kSinTurn, kCosTurn * kSinElevation);
  const Vec2 z(0, kCosElevation);
  const Vec3 size = box.size();
  const Vec2 seen = size.x * glm::abs(x) + size.y * glm::abs(y) + size.z * z;
  scale_ = (kSide - 2 * kMargin) / std::max({seen.x, seen.y, 1e-9});
  map_.per_x = scale_ * Vec2(x.x, -x.y);
  map_.per_y = scale_ * Vec2(y.x, -y.y);
  const Vec3 middle = (box.low + box.high) / 2.0;
  map_.origin = Vec2(0);
  map_.origin = Vec2(kSide) / 2.0 - map_(Vec2(middle)) +
                Vec2(0, scale_ * kCosElevation * middle.z);
  next_z_ = box.low.z;
}

void Preview::take(const Layer& layer) {
  if (scale_ == 0) return;
  const double step = 1 / (scale_ * kCosElevation);  // a pixel
  while (next_z_ <= layer.top) {
    const double z = std::max(next_z_, layer.bottom);
    PixelMap map = map_;
    map.origin.y -= scale_ * kCosElevation * z;
    std::size_t at = 0;
    visit_runs(layer.contours, kSide, kSide, map, 0,
               [&](std::uint8_t grey, std::uint64_t count) {
                 constexpr std::uint8_t kHalf = 128;
                 if (grey >= kHalf) {
                   std::fill_n(
                       heights_.begin() + static_cast<std::ptrdiff_t>(at),
                       count, static_cast<float>(z));
                 }
                 at += count;
               });
    next_z_ = z + step;
  }
}

std::vector<std::uint8_t> Preview::draw(unsigned width, unsigned height) const {
  std::vector<Vec3> lit(heights_.size(), kBackground);
  if (scale_ > 0) {
    const double step = 1 / (scale_ * kCosElevation);
    const Heights heights = smooth(heights_, step);
    for_each_pixel(heights, [&](int u, int v, float /*z*/) {
      lit[index_of(u, v)] = light_on(normal_at(heights, u, v, scale_, step));
    });
  }
  // Each pixel is the mean of some points.
  constexpr int kPoints = 3;  // along each side
  const double zoom = static_cast<double>(kSide) / std::min(width, height);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t{3} * width * height);
  for (unsigned y = 0; y < height; ++y) {
    for (unsigned x = 0; x < width; ++x) {
      Vec3 sum(0);
      for (int i = 0; i < kPoints * kPoints; ++i) {
        const int column = i % kPoints;
        const int row = i / kPoints;
        const Vec2 point = Vec2(x + (column + 0.5) / kPoints - width / 2.0,
                                y + (row + 0.5) / kPoints - height / 2.0) *
                               zoom +
                           Vec2(kSide) / 2.0;
        const bool is_inside =
            point.x >= 0 && point.y >= 0 && point.x < kSide && point.y < kSide;
        sum += is_inside && !lit.empty()
                   ? lit[index_of(static_cast<int>(point.x),
                                  static_cast<int>(point.y))]
                   : kBackground;
      }
      for (int c = 0; c < 3; ++c) {
        pixels.push_back(to_byte(sum[c] / (kPoints * kPoints)));
      }
    }
  }
  return pixels;
}

}  // namespace lamina::slicer
