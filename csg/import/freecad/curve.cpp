#include "csg/import/freecad/detail/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/file/format_error.h"
#include "csg/import/freecad/detail/document.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

using std::numbers::pi;

using Curve = std::function<Vec2(double)>;

// --- Chords -----------------------------------------------------------------

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = glm::dot(along, along);
  const double t =
      square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
  return glm::length(p - a - t * along);
}

Vec2 require_near(Vec2 point) {
  if (plane::is_too_far(point.x) || plane::is_too_far(point.y))
    plane::fail_too_far();
  return point;
}

struct CurvePoint {
  double at;
  Vec2 point;
};

CurvePoint point_at(const Curve& curve, double t) {
  return {t, require_near(curve(t))};
}

// Appends the chords from `a` to `b`, without the corner at `a`.
void append_chords(const Curve& curve, CurvePoint a, CurvePoint b, double error,
                   int depth, Polyline& chords) {
  constexpr int kDeepest = 14;
  const auto at = [&](double share) {
    return point_at(curve, a.at + share * (b.at - a.at));
  };
  const CurvePoint middle = at(0.5);
  const auto is_near = [&](const CurvePoint& p) {
    return distance_to_segment(p.point, a.point, b.point) <= error;
  };
  if (depth == kDeepest ||
      (is_near(middle) && is_near(at(0.25)) && is_near(at(0.75)))) {
    plane::require_corners(chords.size());
    chords.push_back(b.point);
    return;
  }
  append_chords(curve, a, middle, error, depth + 1, chords);
  append_chords(curve, middle, b, error, depth + 1, chords);
}

// breaks  parameters from the begin to the end of the curve; between two of
//         them it is smooth and turns by less than half a turn
Polyline chords_of(const Curve& curve, std::span<const double> breaks,
                   double error) {
  CurvePoint last = point_at(curve, breaks.front());
  Polyline chords = {last.point};
  for (const double at : breaks.subspan(1)) {
    const CurvePoint next = point_at(curve, at);
    append_chords(curve, last, next, error, 0, chords);
    last = next;
  }
  return chords;
}

std::vector<double> equal_parts(double begin, double end, int parts) {
  std::vector<double> breaks;
  for (int i = 0; i <= parts; ++i) {
    breaks.push_back(begin + (end - begin) * i / parts);
  }
  return breaks;
}

bool is_full_turn(double begin, double end) {
  constexpr double kSameAngle = 1e-9;  // radians
  return std::abs(end - begin - 2 * pi) < kSameAngle;
}

// Makes the ends equal where the curve is closed.
void close_turn(double begin, double end, Polyline& chords) {
  if (is_full_turn(begin, end)) chords.back() = chords.front();
}

// --- Conics -----------------------------------------------------------------

// Where a conic stands in the plane of its sketch.
struct Frame {
  Vec2 center;
  Vec2 x;
  Vec2 y;

  Vec2 operator()(Vec2 p) const { return center + p.x * x + p.y * y; }
};

// A normal that looks down, which mirrored and imported sketches have, turns
// the conic around the y axis.
Frame read_frame(const pugi::xml_node& conic) {
  Frame frame;
  frame.center = {read_number(conic, "CenterX"), read_number(conic, "CenterY")};
  const bool looks_down =
      conic.attribute("NormalZ") && read_number(conic, "NormalZ") < 0;
  const double angle =
      conic.attribute("AngleXU") ? read_number(conic, "AngleXU") : 0;
  const Vec2 x(std::cos(angle), std::sin(angle));
  frame.x = looks_down ? Vec2(-x.x, x.y) : x;
  frame.y = Vec2(-x.y, x.x);
  if (looks_down) frame.y.x = -frame.y.x;
  return frame;
}

Polyline placed(const pugi::xml_node& conic, Polyline chords) {
  const Frame frame = read_frame(conic);
  for (Vec2& corner : chords) corner = require_near(frame(corner));
  return chords;
}

// A closed curve lacks the attributes.
std::pair<double, double> read_turn(const pugi::xml_node& conic) {
  if (!conic.attribute("StartAngle")) return {0, 2 * pi};
  const double begin = read_number(conic, "StartAngle");
  double end = read_number(conic, "EndAngle");
  if (end <= begin) end += 2 * pi * std::ceil((begin - end) / (2 * pi));
  if (end <= begin) end += 2 * pi;
  return {begin, std::min(end, begin + 2 * pi)};
}

double read_length(const pugi::xml_node& conic, const char* attribute) {
  const double length = read_number(conic, attribute);
  if (length > 0) return length;
  throw FormatError(fmt::format("FCStd, {} of a {} must be above 0, not {:g}",
                                attribute, conic.name(), length));
}

Polyline read_circle(const pugi::xml_node& conic, double error) {
  const auto [begin, end] = read_turn(conic);
  return placed(conic, arc(read_length(conic, "Radius"), begin, end, error));
}

Polyline read_ellipse(const pugi::xml_node& conic, double error) {
  const auto [begin, end] = read_turn(conic);
  const Vec2 radii(read_length(conic, "MajorRadius"),
                   read_length(conic, "MinorRadius"));
  return placed(conic, elliptic_arc(radii, begin, end, error));
}

constexpr int kOpenConicParts = 4;

Polyline read_hyperbola(const pugi::xml_node& conic, double error) {
  const double a = read_length(conic, "MajorRadius");
  const double b = read_length(conic, "MinorRadius");
  const auto curve = [a, b](double t) {
    return Vec2(a * std::cosh(t), b * std::sinh(t));
  };
  const auto breaks =
      equal_parts(read_number(conic, "StartAngle"),
                  read_number(conic, "EndAngle"), kOpenConicParts);
  // cosh() of more than this is beyond all coordinates.
  constexpr double kGreatestArgument = 20;
  if (std::max(std::abs(breaks.front()), std::abs(breaks.back())) >
      kGreatestArgument) {
    plane::fail_too_far();
  }
  return placed(conic, chords_of(curve, breaks, error));
}

Polyline read_parabola(const pugi::xml_node& conic, double error) {
  const double focal = read_length(conic, "Focal");
  const auto curve = [focal](double t) { return Vec2(t * t / 4 / focal, t); };
  const auto breaks =
      equal_parts(read_number(conic, "StartAngle"),
                  read_number(conic, "EndAngle"), kOpenConicParts);
  return placed(conic, chords_of(curve, breaks, error));
}

// --- B-splines --------------------------------------------------------------

// A rational B-spline, evaluated by de Boor's algorithm. A periodic one is
// unrolled: knots and poles go on around its seam.
struct Spline {
  int degree = 0;
  std::vector<double> knots;  // each as often as it counts
  std::vector<Vec3> poles;    // (x w, y w, w)

  Vec2 operator()(double t) const {
    const auto p = static_cast<std::size_t>(degree);
    const auto upper = std::upper_bound(
        knots.begin() + degree + 1,
        knots.begin() + static_cast<std::ptrdiff_t>(poles.size()), t);
    const auto span = static_cast<std::size_t>(upper - knots.begin()) - 1;
    std::vector<Vec3> d(poles.begin() + static_cast<std::ptrdiff_t>(span - p),
                        poles.begin() + static_cast<std::ptrdiff_t>(span + 1));
    for (std::size_t r = 1; r <= p; ++r) {
      for (std::size_t j = p; j >= r; --j) {
        const double low = knots[j + span - p];
        const double width = knots[j + 1 + span - r] - low;
        const double share = width > 0 ? (t - low) / width : 0;
        d[j] = glm::mix(d[j - 1], d[j], share);
      }
    }
    return Vec2(d[p]) / d[p].z;
  }
};

struct Knot {
  double value;
  int count;
};

std::vector<Knot> read_knots(const pugi::xml_node& curve, int degree) {
  std::vector<Knot> knots;
  for (const pugi::xml_node element : curve.children("Knot")) {
    const Knot knot = {read_number(element, "Value"),
                       element.attribute("Mult").as_int()};
    const bool rises = knots.empty() || knot.value > knots.back().value;
    if (!rises || knot.count < 1 || knot.count > degree + 1) {
      throw FormatError("FCStd, the knots of a BSplineCurve do not rise");
    }
    knots.push_back(knot);
  }
  if (knots.size() < 2) throw FormatError("FCStd, a BSplineCurve lacks knots");
  return knots;
}

std::vector<Vec3> read_poles(const pugi::xml_node& curve) {
  std::vector<Vec3> poles;
  for (const pugi::xml_node pole : curve.children("Pole")) {
    const double weight = read_number(pole, "Weight");
    // Coordinates are divided by weights, and much less leaves no digits.
    constexpr double kLeastWeight = 1e-12;
    if (!(weight >= kLeastWeight)) {
      throw FormatError(fmt::format(
          "FCStd, a weight of a BSplineCurve is {:g}, not 1e-12 or more",
          weight));
    }
    poles.emplace_back(weight * read_number(pole, "X"),
                       weight * read_number(pole, "Y"), weight);
  }
  return poles;
}

// Goes on around the seam until the first and the last knot have degree + 1
// knots on their outer side, themselves included.
void unroll(std::span<const Knot> knots, Spline& spline) {
  const double period = knots.back().value - knots.front().value;
  const int poles = static_cast<int>(spline.poles.size());
  const int outer = spline.degree + 1;
  std::vector<double> cycle;  // of one period, its end left out
  for (const Knot& knot : knots.first(knots.size() - 1)) {
    cycle.insert(cycle.end(), static_cast<std::size_t>(knot.count), knot.value);
  }
  if (static_cast<int>(cycle.size()) != poles) {
    throw FormatError("FCStd, a BSplineCurve lacks poles or knots");
  }
  const auto knot_at = [&](int i) {
    const int turn = i >= 0 ? i / poles : -((poles - 1 - i) / poles);
    return cycle[static_cast<std::size_t>(i - turn * poles)] + turn * period;
  };
  // The last of the first knot's copies is number `first`.
  const int first = knots.front().count - 1;
  const int end = poles + first + outer;  // one behind the last
  spline.knots.clear();
  for (int i = first - spline.degree; i < end; ++i) {
    spline.knots.push_back(knot_at(i));
  }
  for (int i = 0; i < spline.degree; ++i) {
    spline.poles.push_back(
        Vec3(spline.poles[static_cast<std::size_t>(i % poles)]));
  }
}

Polyline read_spline(const pugi::xml_node& curve, double error) {
  constexpr int kGreatestDegree = 25;  // OpenCASCADE's
  Spline spline;
  spline.degree = curve.attribute("Degree").as_int();
  if (spline.degree < 1 || spline.degree > kGreatestDegree) {
    throw FormatError(
        fmt::format("FCStd, the degree of a BSplineCurve is {}, not 1 to 25",
                    spline.degree));
  }
  const std::vector<Knot> knots = read_knots(curve, spline.degree);
  spline.poles = read_poles(curve);
  const bool is_periodic = curve.attribute("IsPeriodic").as_bool();
  if (is_periodic) {
    unroll(knots, spline);
  } else {
    for (const Knot& knot : knots) {
      spline.knots.insert(spline.knots.end(),
                          static_cast<std::size_t>(knot.count), knot.value);
    }
  }
  const auto order = static_cast<std::size_t>(spline.degree) + 1;
  if (spline.poles.size() < order ||
      spline.knots.size() != spline.poles.size() + order) {
    throw FormatError("FCStd, a BSplineCurve lacks poles or knots");
  }
  // Each span is a polynomial, which turns often if its degree is high.
  std::vector<double> breaks = {knots.front().value};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const auto parts =
        equal_parts(knots[i - 1].value, knots[i].value, spline.degree);
    breaks.insert(breaks.end(), parts.begin() + 1, parts.end());
  }
  Polyline chords = chords_of(spline, breaks, error);
  if (is_periodic) chords.back() = chords.front();
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
  for (const double angle : equal_parts(begin, end, parts)) {
    chords.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  close_turn(begin, end, chords);
  return chords;
}

Polyline elliptic_arc(Vec2 radii, double begin, double end, double error) {
  const auto curve = [radii](double t) {
    return radii * Vec2(std::cos(t), std::sin(t));
  };
  constexpr double kPart = pi / 4;
  const int parts =
      std::max(1, static_cast<int>(std::ceil((end - begin) / kPart - 1e-9)));
  Polyline chords = chords_of(curve, equal_parts(begin, end, parts), error);
  close_turn(begin, end, chords);
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
  if (type == "Part::GeomEllipse") {
    return read_ellipse(geometry.child("Ellipse"), error);
  }
  if (type == "Part::GeomArcOfEllipse") {
    return read_ellipse(geometry.child("ArcOfEllipse"), error);
  }
  if (type == "Part::GeomArcOfHyperbola") {
    return read_hyperbola(geometry.child("ArcOfHyperbola"), error);
  }
  if (type == "Part::GeomArcOfParabola") {
    return read_parabola(geometry.child("ArcOfParabola"), error);
  }
  if (type == "Part::GeomBSplineCurve") {
    return read_spline(geometry.child("BSplineCurve"), error);
  }
  return std::nullopt;
}

}  // namespace lamina::csg::freecad
