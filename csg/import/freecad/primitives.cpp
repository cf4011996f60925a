#include "csg/import/freecad/detail/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "csg/degrees.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

using std::numbers::pi;

// A primitive whose parameters make no solid is nothing, and
// `why` names the first that does not fit.
struct Parameters {
  const Object& object;
  std::string& why;

  double operator[](std::string_view name) const { return object.number(name); }
  double angle(std::string_view name, double fallback) const {
    return object.number(name, fallback);
  }
  bool are_positive(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
      if (!(object.number(name) > 0)) return fail(name);
    }
    return true;
  }
  // An angle of a whole body or of a part of it.
  bool is_turn(std::string_view name) const {
    const double turn = angle(name, 360);
    return turn > 0 && turn <= 360 ? true : fail(name);
  }
  bool fail(std::string_view name) const {
    why = fmt::format("its {} makes no solid", name);
    return false;
  }
};

// Prisms and cylinders may lean: their tops stand these angles off the axis.
Solid lean(const Object& object, SolidMaker& maker, const Solid& solid) {
  const auto slope = [&](std::string_view name) {
    return std::tan(object.number(name, 0) * pi / 180);
  };
  Mat4 matrix(1);
  matrix[2] = Vec4(slope("FirstAngle"), slope("SecondAngle"), 1, 0);
  return maker.place(matrix, solid);
}

std::optional<Solid> make_box(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Length", "Width", "Height"})) return std::nullopt;
  return maker.leaf(Cube{Vec3(p["Length"], p["Width"], p["Height"]), false});
}

std::optional<Solid> make_cylinder(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius", "Height"}) || !p.is_turn("Angle")) {
    return std::nullopt;
  }
  const double r = p["Radius"];
  const double h = p["Height"];
  const double turn = p.angle("Angle", 360);
  const Solid upright =
      turn == 360 ? maker.cylinder(h, r, r)
                  : maker.revolve({{{0, 0}, {r, 0}, {r, h}, {0, h}}}, turn);
  return lean(p.object, maker, upright);
}

std::optional<Solid> make_cone(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Height"}) || !p.is_turn("Angle")) return std::nullopt;
  const double h = p["Height"];
  const double bottom = p["Radius1"];
  const double top = p["Radius2"];
  if (std::min(bottom, top) < 0 || std::max(bottom, top) == 0) {
    p.fail("radii");
    return std::nullopt;
  }
  const double turn = p.angle("Angle", 360);
  if (turn == 360) return maker.cylinder(h, bottom, top);
  Polyline contour = {{0, 0}};
  if (bottom > 0) contour.emplace_back(bottom, 0);
  if (top > 0) contour.emplace_back(top, h);
  contour.emplace_back(0, h);
  return maker.revolve({contour}, turn);
}

// What lies between two latitudes of a ball, as far as the axis.
std::optional<Solid> make_ball(const Parameters& p, double radius,
                               SolidMaker& maker) {
  const double low = p.angle("Angle1", -90);
  const double high = p.angle("Angle2", 90);
  if (low < -90 || high > 90 || !(low < high)) {
    p.fail("Angle1 or Angle2");
    return std::nullopt;
  }
  if (!p.is_turn("Angle3")) return std::nullopt;
  const double turn = p.angle("Angle3", 360);
  if (low == -90 && high == 90 && turn == 360) return maker.sphere(radius);
  Polyline contour =
      arc(radius, low * pi / 180, high * pi / 180, maker.chordal_error() / 2);
  if (low == -90) contour.front().x = 0;
  if (high == 90) contour.back().x = 0;
  for (const double end : {high, low}) {
    const Vec2 on_axis(0, radius * sin_deg(end));
    if (std::abs(end) != 90) contour.push_back(on_axis);
  }
  return maker.revolve({contour}, turn);
}

std::optional<Solid> make_sphere(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius"})) return std::nullopt;
  return make_ball(p, p["Radius"], maker);
}

// A ball of its greatest half axis, compressed.
std::optional<Solid> make_ellipsoid(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius1", "Radius2"})) return std::nullopt;
  const double third = p.object.number("Radius3", 0);
  const Vec3 radii(p["Radius2"], third > 0 ? third : p["Radius2"],
                   p["Radius1"]);
  const double greatest = std::max({radii.x, radii.y, radii.z});
  const auto ball = make_ball(p, greatest, maker);
  if (!ball) return std::nullopt;
  Mat4 matrix(1);
  for (int i = 0; i < 3; ++i) matrix[i][i] = radii[i] / greatest;
  return maker.place(matrix, *ball);
}

// Of the tube's disk, the sector between two angles, which run downwards from
// its outermost point.
std::optional<Solid> make_torus(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius1", "Radius2"}) || !p.is_turn("Angle3")) {
    return std::nullopt;
  }
  const double ring = p["Radius1"];
  const double tube = p["Radius2"];
  const double begin = p.angle("Angle1", -180);
  const double end = p.angle("Angle2", 180);
  if (!(tube < ring)) {
    p.fail("Radius2");
    return std::nullopt;
  }
  if (!(begin < end) || end - begin > 360) {
    p.fail("Angle1 or Angle2");
    return std::nullopt;
  }
  Polyline contour =
      arc(tube, begin * pi / 180, end * pi / 180, maker.chordal_error() / 2);
  if (end - begin == 360) {
    contour.pop_back();
  } else {
    contour.emplace_back(0, 0);
  }
  for (Vec2& corner : contour) corner = {ring + corner.x, -corner.y};
  return maker.revolve({contour}, p.angle("Angle3", 360));
}

std::optional<Solid> make_prism(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Circumradius", "Height"})) return std::nullopt;
  const int sides = p.object.count("Polygon");
  if (sides < 3) {
    p.fail("Polygon");
    return std::nullopt;
  }
  require_fragments(sides);
  Facets facets;
  facets.fn = sides;
  const double r = p["Circumradius"];
  return lean(p.object, maker,
              maker.leaf(Cylinder{p["Height"], r, r, false, facets}));
}

// A rectangle at Ymin and another, or a line, or a point, at Ymax.
std::optional<Solid> make_wedge(const Parameters& p, SolidMaker& maker) {
  const std::array<Vec2, 4> bottom = {{{p["Xmin"], p["Zmin"]},
                                       {p["Xmax"], p["Zmin"]},
                                       {p["Xmax"], p["Zmax"]},
                                       {p["Xmin"], p["Zmax"]}}};
  const std::array<Vec2, 4> top = {{{p["X2min"], p["Z2min"]},
                                    {p["X2max"], p["Z2min"]},
                                    {p["X2max"], p["Z2max"]},
                                    {p["X2min"], p["Z2max"]}}};
  if (!(p["Ymin"] < p["Ymax"]) || !(bottom[0].x < bottom[2].x) ||
      !(bottom[0].y < bottom[2].y) || top[0].x > top[2].x ||
      top[0].y > top[2].y) {
    p.fail("box");
    return std::nullopt;
  }
  std::vector<Vec3> points;
  points.reserve(8);
  for (const Vec2 q : bottom) points.emplace_back(q.x, p["Ymin"], q.y);
  for (const Vec2 q : top) points.emplace_back(q.x, p["Ymax"], q.y);
  // Corners that coincide become one.
  std::array<std::uint32_t, 8> name{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    name[i] = static_cast<std::uint32_t>(
        std::find(points.begin(), points.begin() + i, points[i]) -
        points.begin());
  }
  std::vector<std::vector<std::uint32_t>> faces;
  const std::vector<std::vector<std::uint32_t>> all = {
      {3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& corners : all) {
    std::vector<std::uint32_t> face;
    for (const std::uint32_t corner : corners) {
      const std::uint32_t n = name[corner];
      if (std::find(face.begin(), face.end(), n) == face.end()) {
        face.push_back(n);
      }
    }
    if (face.size() > 2) faces.push_back(face);
  }
  return maker.polyhedron(points, faces);
}

}  // namespace

std::optional<Solid> make_primitive(std::string_view kind, const Object& object,
                                    SolidMaker& maker, std::string& why) {
  using Make = std::optional<Solid> (*)(const Parameters&, SolidMaker&);
  static const std::map<std::string_view, Make> kMakers = {
      {"Box", make_box},       {"Cylinder", make_cylinder},
      {"Sphere", make_sphere}, {"Cone", make_cone},
      {"Torus", make_torus},   {"Prism", make_prism},
      {"Wedge", make_wedge},   {"Ellipsoid", make_ellipsoid}};
  const auto found = kMakers.find(kind);
  if (found == kMakers.end()) return std::nullopt;
  return found->second({object, why}, maker);
}

}  // namespace lamina::csg::freecad
