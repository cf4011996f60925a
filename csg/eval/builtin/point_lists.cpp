#include "csg/eval/builtin/point_lists.h"

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "csg/eval/builtin/conversions.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {
namespace {

// `convert` makes a point of a value, or none.
template <typename Point, typename Convert>
std::optional<std::vector<Point>> read_points(const ModuleCall& call,
                                              std::string_view type,
                                              const Convert& convert) {
  const Value& given = call["points"];
  if (!given.is_vector()) {
    call.warn("Unable to convert points = {} to a vector of coordinates",
              to_echo(given));
    return std::nullopt;
  }
  std::vector<Point> points;
  for (const Value& value : given.as_vector()) {
    std::optional<Point> point = convert(value);
    // 0 · x is NaN where x is not finite.
    if (!point || glm::dot(*point, Point(0)) != 0) {
      call.warn("Unable to convert points[{}] = {} to a {} of numbers",
                points.size(), to_echo(value), type);
      point = Point(0);
    }
    points.push_back(*point);
  }
  return points;
}

}  // namespace

std::optional<std::vector<Vec2>> read_points_2d(const ModuleCall& call) {
  return read_points<Vec2>(call, "vec2",
                           [](const Value& value) { return to_vec2(value); });
}

std::optional<std::vector<Vec3>> read_points_3d(const ModuleCall& call) {
  return read_points<Vec3>(
      call, "vec3", [](const Value& value) { return to_vec3(value, 0.0); });
}

std::optional<std::span<const std::span<const std::uint32_t>>> read_index_lists(
    std::string_view parameter, std::size_t points, std::size_t least,
    const ModuleCall& call) {
  const Value& given = call[parameter];
  if (!given.is_vector()) {
    call.warn(
        "Unable to convert {} = {} to a vector of vector of point indices",
        parameter, to_echo(given));
    return std::nullopt;
  }
  std::vector<std::span<const std::uint32_t>> lists;
  const std::span<const Value> values = given.as_vector();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i].is_vector()) {
      call.warn("Unable to convert {}[{}] = {} to a vector of numbers",
                parameter, i, to_echo(values[i]));
      continue;
    }
    std::vector<std::uint32_t> indices;
    const std::span<const Value> list = values[i].as_vector();
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!list[k].is_number()) {
        call.warn("Unable to convert {}[{}][{}] = {} to a number", parameter, i,
                  k, to_echo(list[k]));
        continue;
      }
      const double index = std::trunc(list[k].as_number());
      if (index >= 0 && index < static_cast<double>(points)) {
        indices.push_back(static_cast<std::uint32_t>(index));
      } else {
        call.warn("Point index {:.0f} is out of bounds (from {}[{}][{}])",
                  index, parameter, i, k);
      }
    }
    if (indices.size() >= least) {
      lists.push_back(call.in.keep_all<std::uint32_t>(indices));
    }
  }
  return call.in.keep_all<std::span<const std::uint32_t>>(lists);
}

}  // namespace lamina::csg
