#include "csg/import/freecad/detail/primitives.h"

#include <algorithm>
#include <map>
#include <numbers>

#include <fmt/format.h>

namespace lamina::csg::freecad {
namespace {

// The parameters of a primitive. `why` names the first that makes no solid, or
// that makes a part of a body or a leaning one.
struct Parameters {
  const Object& object;
  std::string& why;

  double operator[](std::string_view name) const { return object.number(name); }
  bool are_positive(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
      if (!(object.number(name) > 0)) return fail(name);
    }
    return true;
  }
  bool is(std::string_view name, double expected) const {
    if (object.number(name, expected) == expected) return true;
    why = fmt::format("its {} is not {:g}", name, expected);
    return false;
  }
  bool fail(std::string_view name) const {
    why = fmt::format("its {} makes no solid", name);
    return false;
  }
};

std::optional<Solid> make_box(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Length", "Width", "Height"})) return std::nullopt;
  return maker.leaf(Cube{Vec3(p["Length"], p["Width"], p["Height"]), false});
}

std::optional<Solid> make_cylinder(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius", "Height"}) || !p.is("Angle", 360) ||
      !p.is("FirstAngle", 0) || !p.is("SecondAngle", 0)) {
    return std::nullopt;
  }
  return maker.cylinder(p["Height"], p["Radius"], p["Radius"]);
}

std::optional<Solid> make_cone(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Height"}) || !p.is("Angle", 360)) return std::nullopt;
  const double bottom = p["Radius1"];
  const double top = p["Radius2"];
  if (std::min(bottom, top) < 0 || std::max(bottom, top) == 0) {
    p.fail("radii");
    return std::nullopt;
  }
  return maker.cylinder(p["Height"], bottom, top);
}

std::optional<Solid> make_sphere(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius"}) || !p.is("Angle1", -90) ||
      !p.is("Angle2", 90) || !p.is("Angle3", 360)) {
    return std::nullopt;
  }
  return maker.sphere(p["Radius"]);
}

std::optional<Solid> make_torus(const Parameters& p, SolidMaker& maker) {
  if (!p.are_positive({"Radius1", "Radius2"}) || !p.is("Angle1", -180) ||
      !p.is("Angle2", 180) || !p.is("Angle3", 360)) {
    return std::nullopt;
  }
  const double ring = p["Radius1"];
  const double tube = p["Radius2"];
  if (!(tube < ring)) {
    p.fail("Radius2");
    return std::nullopt;
  }
  using std::numbers::pi;
  Polyline contour = arc(tube, -pi, pi, maker.chordal_error_of_turned());
  contour.pop_back();
  for (Vec2& corner : contour) corner = {ring + corner.x, -corner.y};
  return maker.revolve({contour}, 360);
}

using Make = std::optional<Solid> (*)(const Parameters&, SolidMaker&);

Make maker_of(std::string_view kind) {
  static const std::map<std::string_view, Make> kMakers = {
      {"Box", make_box},
      {"Cylinder", make_cylinder},
      {"Sphere", make_sphere},
      {"Cone", make_cone},
      {"Torus", make_torus}};
  const auto found = kMakers.find(kind);
  return found == kMakers.end() ? nullptr : found->second;
}

}  // namespace

bool is_primitive(std::string_view kind) { return maker_of(kind) != nullptr; }

std::optional<Solid> make_primitive(std::string_view kind, const Object& object,
                                    SolidMaker& maker, std::string& why) {
  return maker_of(kind)({object, why}, maker);
}

}  // namespace lamina::csg::freecad
