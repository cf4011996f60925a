#include "tests/ldni/image/ray_reference.h"

#include <algorithm>
#include <sstream>
#include <tuple>

#include "ldni/image/boolean.h"
#include "ldni/image/ray_grid.h"
#include "ldni/image/sampler.h"

namespace lamina::ldni {
namespace {

// Depths where a ray crosses something, with the change of winding number.
using Crossings = std::vector<std::pair<double, int>>;

Ranges inside_of(Crossings crossings) {
  std::sort(crossings.begin(), crossings.end());
  Ranges ranges;
  int winding = 0;
  for (const auto& [depth, change] : crossings) {
    const bool was_inside = winding != 0;
    winding += change;
    if (was_inside == (winding != 0)) continue;
    if (was_inside) {
      ranges.back().exit = depth;
    } else {
      ranges.push_back({depth, depth});
    }
  }
  return ranges;
}

bool contains(const Ranges& ranges, double depth) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const Range& range) {
    return range.enter <= depth && depth < range.exit;
  });
}

double depth_at(const Vec2& a, const Vec2& b, double x) {
  return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
}

}  // namespace

std::vector<Ranges> evaluate_layers(const csg::Scene& scene,
                                    const LayerGrid& layers, double& x) {
  // One ray; it stands in its grid by a share of the pitch.
  const double share = RayGrid(0, 1, 1).ray_x(0);
  const RayGrid rays(x - share, x + 0.5, 1);
  x = rays.ray_x(0);
  LeafImages images;
  const auto sampler = make_scanline_sampler(scene, rays, layers);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const GridBox box = local_box(scene.instances[i].box, rays, layers);
    if (!box.is_empty()) sampler->sample({i, box}, images);
  }
  RayBoolean boolean(scene);
  std::vector<Ranges> result(layers.layer_count());
  for (std::uint32_t layer = 0; layer < layers.layer_count(); ++layer) {
    std::vector<Sample> samples;
    for (const LeafImage& image : images.images) {
      const GridBox& box = image.box;
      if (layer < box.layer_start || layer >= box.layer_end()) continue;
      const auto found = images.ray(image, layer - box.layer_start, 0);
      samples.insert(samples.end(), found.begin(), found.end());
    }
    std::vector<Interval> intervals;
    boolean.evaluate(samples, intervals);
    for (const Interval& interval : intervals) {
      result[layer].push_back({interval.enter.depth, interval.exit.depth});
    }
  }
  return result;
}

Ranges cut_contours(const plane::Contours& contours, double x) {
  Crossings crossings;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    Vec2 from = loop.back();
    for (const Vec2& to : loop) {
      const bool from_right = from.x > x;
      if (from_right != (to.x > x)) {
        // Towards +x the solid is on the left: above.
        crossings.emplace_back(depth_at(from, to, x), from_right ? -1 : 1);
      }
      from = to;
    }
  }
  return inside_of(std::move(crossings));
}

Ranges cut_chains(const plane::ChainBlock& block, std::uint32_t layer,
                  std::uint32_t instance, double x) {
  Crossings crossings;
  for (const plane::Chain& chain : block.layer(layer)) {
    if (chain.operand != instance) continue;
    const Vec2* const points = block.points.data() + chain.first_point;
    for (std::uint32_t i = 1; i < chain.point_count; ++i) {
      if (points[i - 1].x <= x && x < points[i].x) {
        crossings.emplace_back(depth_at(points[i - 1], points[i], x),
                               chain.winding);
      }
    }
  }
  return inside_of(std::move(crossings));
}

std::string compare_ranges(const Ranges& result, const Ranges& expected,
                           double x, const RangesAt& near_result,
                           const RangesAt& near_expected) {
  // Walk the ends of both; between them nothing changes.
  std::vector<double> depths;
  for (const Ranges* ranges : {&result, &expected}) {
    for (const Range& range : *ranges) {
      depths.push_back(range.enter);
      depths.push_back(range.exit);
    }
  }
  std::sort(depths.begin(), depths.end());
  for (std::size_t i = 0; i + 1 < depths.size(); ++i) {
    if (depths[i + 1] - depths[i] <= kAllowedDistance) continue;
    const double middle = (depths[i] + depths[i + 1]) / 2;
    const bool is_inside = contains(result, middle);
    if (is_inside == contains(expected, middle)) continue;
    const auto is_thin = [&](double shift) {
      return contains(near_expected(x + shift), middle) == is_inside ||
             contains(near_result(x + shift), middle) != is_inside;
    };
    if (is_thin(-kAllowedDistance) || is_thin(kAllowedDistance)) continue;
    std::ostringstream message;
    message.precision(17);
    message << "at x = " << x << " the result is "
            << (is_inside ? "inside" : "outside") << " for y from " << depths[i]
            << " to " << depths[i + 1] << ", expected the opposite";
    return message.str();
  }
  return {};
}

}  // namespace lamina::ldni
