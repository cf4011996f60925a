#include "csg/import/freecad/detail/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "csg/import/freecad/detail/document.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

using std::numbers::pi;

// A closed curve lacks the attributes.
std::pair<double, double> read_turn(const pugi::xml_node& circle) {
  if (!circle.attribute("StartAngle")) return {0, 2 * pi};
  const double begin = read_number(circle, "StartAngle");
  double end = read_number(circle, "EndAngle");
  if (end <= begin) end += 2 * pi * std::ceil((begin - end) / (2 * pi));
  if (end <= begin) end += 2 * pi;
  return {begin, std::min(end, begin + 2 * pi)};
}

double read_radius(const pugi::xml_node& circle) {
  const double radius = read_number(circle, "Radius");
  if (radius > 0) return radius;
  throw FormatError(
      fmt::format("FCStd, Radius of a {} must be above 0, not "
                  "{:g}",
                  circle.name(), radius));
}

// A normal that looks down, which mirrored and imported sketches have, turns
// the circle around the y axis.
Polyline read_circle(const pugi::xml_node& circle, double error) {
  const Vec2 center(read_number(circle, "CenterX"),
                    read_number(circle, "CenterY"));
  const bool looks_down =
      circle.attribute("NormalZ") && read_number(circle, "NormalZ") < 0;
  const double angle =
      circle.attribute("AngleXU") ? read_number(circle, "AngleXU") : 0;
  Vec2 x(std::cos(angle), std::sin(angle));
  if (looks_down) x.x = -x.x;
  const Vec2 y = looks_down ? Vec2(x.y, -x.x) : Vec2(-x.y, x.x);
  const auto [begin, end] = read_turn(circle);
  Polyline chords = arc(read_radius(circle), begin, end, error);
  for (Vec2& corner : chords) {
    corner = center + corner.x * x + corner.y * y;
    if (plane::is_too_far(corner.x) || plane::is_too_far(corner.y))
      plane::fail_too_far();
  }
  return chords;
}

}  // namespace

int circle_chords(double radius, double error) {
  constexpr int kFewest = 8;
  if (!(error < radius)) return kFewest;
  const double count = std::ceil(pi / std::acos(1 - error / radius));
  require_fragments(count);
  return std::max(static_cast<int>(count), kFewest);
}

Polyline arc(double radius, double begin, double end, double error) {
  const double turns = (end - begin) / (2 * pi);
  const int parts = std::max(
      1, static_cast<int>(std::ceil(circle_chords(radius, error) * turns)));
  Polyline chords;
  for (int i = 0; i <= parts; ++i) {
    const double angle = begin + (end - begin) * i / parts;
    chords.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  constexpr double kSameAngle = 1e-9;  // radians
  const bool is_closed = std::abs(end - begin - 2 * pi) < kSameAngle;
  if (is_closed) chords.back() = chords.front();
  return chords;
}

std::optional<Polyline> read_curve(const pugi::xml_node& geometry,
                                   double error) {
  const std::string_view type = geometry.attribute("type").value();
  if (type == "Part::GeomLineSegment") {
    const pugi::xml_node line = geometry.child("LineSegment");
    return Polyline{{read_number(line, "StartX"), read_number(line, "StartY")},
                    {read_number(line, "EndX"), read_number(line, "EndY")}};
  }
  if (type == "Part::GeomCircle") {
    return read_circle(geometry.child("Circle"), error);
  }
  if (type == "Part::GeomArcOfCircle") {
    return read_circle(geometry.child("ArcOfCircle"), error);
  }
  return std::nullopt;
}

}  // namespace lamina::csg::freecad
