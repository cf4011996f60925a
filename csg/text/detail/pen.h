#pragma once
// Draws the outlines of glyphs as polygons.
//
// A curve becomes chords that are evenly spaced in its parameter, as in
// OpenSCAD 2021.01; their number is given, or as small as a chordal error
// allows.

#include <cstdint>
#include <vector>

#include <ft2build.h>

#include "base/vec.h"
#include "csg/text/typesetter.h"
#include FT_OUTLINE_H

namespace lamina::text {

class Pen {
 public:
  // size  scales everything [mm]
  Pen(double size, const Chords& chords) : size_(size), chords_(chords) {}

  // origin  where the outline's origin lies, before scaling
  void draw(FT_Outline& outline, Vec2 origin);

  // The points of all polygons, one after another, and where each ends.
  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<std::uint32_t>& ends() const { return ends_; }

 private:
  struct Strokes;  // FreeType's calls

  void move_to(Vec2 to);
  void line_to(Vec2 to);
  void curve_to(Vec2 control, Vec2 to);
  void curve_to(Vec2 control1, Vec2 control2, Vec2 to);
  // Chords of a curve whose second derivative is at most `bend`, before
  // scaling.
  int chord_count(double bend) const;
  // point_at  gives the curve's point at the share a of its way; b is 1 - a
  template <typename PointAt>
  void add_curve(double bend, Vec2 to, const PointAt& point_at);
  void add(Vec2 point);
  void close();

  double size_;
  Chords chords_;
  Vec2 origin_ = Vec2(0);
  Vec2 at_ = Vec2(0);
  std::vector<Vec2> points_;
  std::vector<std::uint32_t> ends_;
};

}  // namespace lamina::text
