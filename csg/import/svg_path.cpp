#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "csg/degrees.h"
#include "csg/import/detail/svg_numbers.h"
#include "csg/import/detail/svg_parts.h"

namespace lamina::csg {
namespace {

// Ends further apart than this make a path open.
constexpr double kOpenDistance = 0.1;

double distance(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

// The vector's angle, whole where it is so up to rounding.
double angle_deg(Vec2 v) {
  constexpr double kRounding = 3e-14;
  const double angle = std::atan2(v.y, v.x) * (180.0 / std::numbers::pi);
  const double whole = std::round(angle);
  return std::abs(angle - whole) < kRounding ? whole : angle;
}

// From u to v, counter-clockwise, in [0, 360).
double angle_between_deg(Vec2 u, Vec2 v) {
  const double angle = angle_deg(v) - angle_deg(u);
  return angle < 0 ? angle + 360 : angle;
}

class PathReader {
 public:
  PathReader(std::string_view data, const SvgCurves& curves)
      : numbers_(data), curves_(curves) {}

  std::vector<SvgSubpath> read() {
    while (const char c = numbers_.peek()) {
      if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
        command_ = c;
        numbers_.skip(1);
        if (c == 'z' || c == 'Z') close();
      } else if (!run_command()) {
        break;  // malformed from here on
      }
    }
    finish_last();
    return std::move(paths_);
  }

 private:
  bool is_relative() const {
    return std::islower(static_cast<unsigned char>(command_)) != 0;
  }

  // Returns false where numbers of the command are missing.
  bool run_command() {
    switch (std::toupper(static_cast<unsigned char>(command_))) {
      case 'M':
        return move();
      case 'L':
        return with_points(1, [this](const Vec2* p) { add(p[0]); });
      case 'H':
        return along(0);
      case 'V':
        return along(1);
      case 'C':
        return with_points(
            3, [this](const Vec2* p) { add_cubic(p[0], p[1], p[2]); });
      case 'S':
        return with_points(2, [this](const Vec2* p) {
          add_cubic(was_cubic_ ? mirrored() : at_, p[0], p[1]);
        });
      case 'Q':
        return with_points(
            2, [this](const Vec2* p) { add_quadratic(p[0], p[1]); });
      case 'T':
        return with_points(1, [this](const Vec2* p) {
          add_quadratic(was_quadratic_ ? mirrored() : at_, p[0]);
        });
      case 'A':
        return arc();
      default:
        return false;
    }
  }

  // Reads `count` points, relative ones from where the path is.
  template <typename Use>
  bool with_points(std::size_t count, Use use) {
    Vec2 points[3] = {};
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = numbers_.next();
      const auto y = numbers_.next();
      if (!x || !y) return false;
      points[i] = Vec2(*x, *y) + (is_relative() ? at_ : Vec2(0));
    }
    use(points);
    return true;
  }

  bool along(int axis) {
    const auto number = numbers_.next();
    if (!number) return false;
    Vec2 to = at_;
    to[axis] = is_relative() ? to[axis] + *number : *number;
    add(to);
    return true;
  }

  bool move() {
    return with_points(1, [this](const Vec2* p) {
      // Further pairs are lines.
      command_ = is_relative() ? 'l' : 'L';
      if (!points().empty()) {
        paths_.back().is_drawn = is_open();
        paths_.emplace_back();
      }
      add(p[0]);
    });
  }

  bool arc() {
    const auto rx = numbers_.next();
    const auto ry = numbers_.next();
    const auto tilt = numbers_.next();
    const auto is_large = numbers_.next_flag();
    const auto is_positive = numbers_.next_flag();
    if (!rx || !ry || !tilt || !is_large || !is_positive) return false;
    return with_points(1, [&](const Vec2* p) {
      const Vec2 radii(std::abs(*rx), std::abs(*ry));
      const bool is_line = !(radii.x > 0 && radii.y > 0) || p[0] == at_;
      if (!is_line) add_arc(radii, *tilt, *is_large, *is_positive, p[0]);
      add(p[0], is_line);
    });
  }

  std::vector<Vec2>& points() { return paths_.back().points; }

  // Goes to `to`, and draws a line there.
  void add(Vec2 to, bool is_point = true) {
    if (is_point) points().push_back(to);
    at_ = to;
    was_cubic_ = was_quadratic_ = false;
  }

  Vec2 mirrored() const { return at_ + (at_ - control_); }

  void add_cubic(Vec2 c1, Vec2 c2, Vec2 to) {
    const int lines = lines_of_bezier(curves_);
    for (int i = 1; i <= lines; ++i) {
      const double a = i * (1.0 / lines);
      const double b = 1 - a;
      points().push_back(at_ * (b * b * b) + c1 * (3 * b * b * a) +
                         c2 * (3 * b * a * a) + to * (a * a * a));
    }
    add(to, false);
    control_ = c2;
    was_cubic_ = true;
  }

  void add_quadratic(Vec2 c, Vec2 to) {
    const int lines = lines_of_bezier(curves_);
    for (int i = 1; i <= lines; ++i) {
      const double a = i * (1.0 / lines);
      const double b = 1 - a;
      points().push_back(at_ * (b * b) + c * (2 * b * a) + to * (a * a));
    }
    add(to, false);
    control_ = c;
    was_quadratic_ = true;
  }

  // SVG 1.1, appendix F.6.5: from two points and the radii to the centre.
  void add_arc(Vec2 radii, double tilt_deg, bool is_large, bool is_positive,
               Vec2 to) {
    const double cos = cos_deg(tilt_deg);
    const double sin = sin_deg(tilt_deg);
    const Vec2 half = (at_ - to) / 2.0;
    const Vec2 p(cos * half.x + sin * half.y, cos * half.y - sin * half.x);
    // Radii that are too small to reach grow.
    const double reach =
        p.x * p.x / (radii.x * radii.x) + p.y * p.y / (radii.y * radii.y);
    if (reach > 1) radii *= std::sqrt(reach);
    // Multiplied in OpenSCAD's order: the number of steps below jumps where
    // the angle is a multiple of 18 degrees, as it mostly is.
    const auto [rx, ry] = std::pair(radii.x, radii.y);
    const double across_x = rx * rx * p.y * p.y;
    const double across_y = ry * ry * p.x * p.x;
    const double left = std::max(rx * rx * ry * ry - across_x - across_y, 0.0);
    const double factor = std::sqrt(left / (across_x + across_y)) *
                          (is_large == is_positive ? -1 : 1);
    const Vec2 c(factor * rx * p.y / ry, factor * -ry * p.x / rx);
    const Vec2 center =
        Vec2(cos * c.x - sin * c.y, sin * c.x + cos * c.y) + (at_ + to) / 2.0;
    const Vec2 u = (p - c) / radii;
    const Vec2 v = (-p - c) / radii;
    const double begin = angle_between_deg({1, 0}, u);
    const double sweep = angle_between_deg(u, v) - (is_positive ? 0 : 360);
    // The ends are too close, or the radii too large, to compute the centre.
    if (!std::isfinite(sweep)) {
      points().push_back(to);
      return;
    }
    const int steps = lines_of_arc(curves_, std::max(rx, ry), sweep);
    for (int i = 0; i <= steps; ++i) {
      const double phi = begin + sweep * i / steps;
      const Vec2 e = Vec2(cos_deg(phi), sin_deg(phi)) * radii;
      points().push_back(center +
                         Vec2(cos * e.x - sin * e.y, sin * e.x + cos * e.y));
    }
  }

  void close() {
    if (!points().empty()) {
      at_ = points().front();
      points().push_back(at_);
    }
    paths_.emplace_back();
    has_closed_ = true;
    was_cubic_ = was_quadratic_ = false;
  }

  bool is_open() {
    return distance(points().front(), points().back()) > kOpenDistance;
  }

  // Where any subpath was closed by a command, so is the last one.
  void finish_last() {
    while (!paths_.empty() && paths_.back().points.empty()) paths_.pop_back();
    if (!paths_.empty() && !has_closed_) paths_.back().is_drawn = is_open();
  }

  SvgNumbers numbers_;
  const SvgCurves& curves_;
  char command_ = ' ';
  std::vector<SvgSubpath> paths_{1};
  Vec2 at_ = Vec2(0);
  Vec2 control_ = Vec2(0);  // of the last curve
  bool was_cubic_ = false;
  bool was_quadratic_ = false;
  bool has_closed_ = false;
};

}  // namespace

int lines_of_ellipse(const SvgCurves& curves, double radius) {
  constexpr int kFewest = 40;
  if (!curves.lines_of_arc) return kFewest;
  return std::max(curves.lines_of_arc(radius, 360), kFewest);
}

int lines_of_arc(const SvgCurves& curves, double radius, double sweep_deg) {
  const int fewest = static_cast<int>(std::abs(sweep_deg) * 10.0 / 180 + 4);
  if (!curves.lines_of_arc) return fewest;
  return std::max(curves.lines_of_arc(radius, std::abs(sweep_deg)), fewest);
}

int lines_of_bezier(const SvgCurves& curves) {
  constexpr int kFewest = 20;
  return std::max(curves.lines_of_bezier, kFewest);
}

std::vector<SvgSubpath> parse_svg_path(std::string_view data,
                                       const SvgCurves& curves) {
  return PathReader(data, curves).read();
}

}  // namespace lamina::csg
