#include "csg/text/detail/pen.h"

#include <algorithm>
#include <cmath>
#include <new>

#include <glm/geometric.hpp>

#include "csg/text/detail/font_cache.h"

namespace lamina::text {
namespace {

// A point of an outline in the units of text(size = 1).
Vec2 to_vec(const FT_Vector* point) {
  return {static_cast<double>(point->x) / Face::kSize,
          static_cast<double>(point->y) / Face::kSize};
}

}  // namespace

// FreeType is C: nothing may be thrown through it.
struct Pen::Strokes {
  template <typename Stroke>
  static int draw(void* pen, Stroke stroke) noexcept {
    try {
      stroke(*static_cast<Pen*>(pen));
      return 0;
    } catch (const std::bad_alloc&) {
      return 1;
    }
  }
  static int move_to(const FT_Vector* to, void* pen) noexcept {
    return draw(pen, [&](Pen& p) { p.move_to(to_vec(to)); });
  }
  static int line_to(const FT_Vector* to, void* pen) noexcept {
    return draw(pen, [&](Pen& p) { p.line_to(to_vec(to)); });
  }
  static int conic_to(const FT_Vector* control, const FT_Vector* to,
                      void* pen) noexcept {
    return draw(pen, [&](Pen& p) { p.curve_to(to_vec(control), to_vec(to)); });
  }
  static int cubic_to(const FT_Vector* control1, const FT_Vector* control2,
                      const FT_Vector* to, void* pen) noexcept {
    return draw(pen, [&](Pen& p) {
      p.curve_to(to_vec(control1), to_vec(control2), to_vec(to));
    });
  }
};

void Pen::draw(FT_Outline& outline, Vec2 origin) {
  origin_ = origin;
  FT_Outline_Funcs strokes = {};
  strokes.move_to = Strokes::move_to;
  strokes.line_to = Strokes::line_to;
  strokes.conic_to = Strokes::conic_to;
  strokes.cubic_to = Strokes::cubic_to;
  // A malformed outline is drawn as far as it goes, as in OpenSCAD.
  const FT_Error error = FT_Outline_Decompose(&outline, &strokes, this);
  if (error == 1) throw std::bad_alloc();
  close();
}

void Pen::move_to(Vec2 to) {
  close();
  line_to(to);
}

void Pen::line_to(Vec2 to) {
  add(to);
  at_ = to;
}

// A chord over a step h of the parameter is at most max|B''| h²/8 away.
int Pen::chord_count(double bend) const {
  constexpr double kMost = 1 << 16;
  if (!(chords_.error > 0)) return chords_.count;
  const double n = std::sqrt(std::abs(size_) * bend / (8 * chords_.error));
  return static_cast<int>(std::clamp(std::ceil(n), 1.0, kMost));
}

template <typename PointAt>
void Pen::add_curve(double bend, Vec2 to, const PointAt& point_at) {
  const int n = chord_count(bend);
  for (int i = 1; i <= n; ++i) {
    const double a = static_cast<double>(i) / n;
    add(point_at(a, 1 - a));
  }
  at_ = to;
}

void Pen::curve_to(Vec2 control, Vec2 to) {
  const double bend = 2 * glm::length(at_ - 2.0 * control + to);
  add_curve(bend, to, [&](double a, double b) {
    return b * b * at_ + 2 * a * b * control + a * a * to;
  });
}

void Pen::curve_to(Vec2 control1, Vec2 control2, Vec2 to) {
  const double bend = 6 * std::max(glm::length(at_ - 2.0 * control1 + control2),
                                   glm::length(control1 - 2.0 * control2 + to));
  add_curve(bend, to, [&](double a, double b) {
    return b * b * b * at_ + 3 * a * b * b * control1 +
           3 * a * a * b * control2 + a * a * a * to;
  });
}

void Pen::add(Vec2 point) { points_.push_back(size_ * (point + origin_)); }

void Pen::close() {
  const std::size_t begin = ends_.empty() ? 0 : ends_.back();
  if (points_.size() > begin) {
    ends_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
}

}  // namespace lamina::text
