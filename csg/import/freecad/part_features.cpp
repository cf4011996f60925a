// Features of FreeCAD's workbench Part: primitives, Booleans, extrusions,
// bodies of revolution, mirrored shapes.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csg/import/freecad/detail/primitives.h"
#include "csg/import/freecad/detail/reader.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

// Directions that differ by a lesser sine are one.
constexpr double kSameWay = 1e-9;

constexpr double kNowhere = 1e-7;  // mm: FreeCAD's `Precision::Confusion`

}  // namespace

Reader::Made Reader::make_part_primitive(const Object& object,
                                         std::string& why) {
  const std::string_view kind = object.type().substr(sizeof("Part::") - 1);
  const Made solid = make_primitive(kind, object, maker_, why);
  if (!solid) return std::nullopt;
  return maker_.place(object.placement(), *solid);
}

// --- Booleans ---------------------------------------------------------------

std::optional<std::vector<Solid>> Reader::make_operands(
    const std::vector<std::string_view>& names, std::string& why) {
  std::vector<Solid> solids;
  for (const std::string_view name : names) {
    const Made solid = make(name);
    if (!solid) {
      why = fmt::format("'{}' is no solid", name);
      return std::nullopt;
    }
    solids.push_back(*solid);
  }
  if (solids.empty()) {
    why = "it is made of nothing";
    return std::nullopt;
  }
  return solids;
}

namespace {

// A Boolean has two operands, or a list of them.
std::vector<std::string_view> operand_names(const Object& object) {
  for (const char* const list : {"Shapes", "Links"}) {
    if (object.value(list)) return object.links(list);
  }
  return {object.link("Base"), object.link("Tool")};
}

}  // namespace

Reader::Made Reader::make_boolean(const Object& object, std::string& why) {
  const auto solids = make_operands(operand_names(object), why);
  if (!solids) return std::nullopt;
  const std::string_view type = object.type();
  const Solid solid = type.ends_with("Cut")      ? maker_.subtract(*solids)
                      : type.ends_with("Common") ? maker_.intersect(*solids)
                                                 : maker_.unite(*solids);
  return maker_.place(object.placement(), solid);
}

Reader::Made Reader::make_mirroring(const Object& object, std::string& why) {
  const auto base = object.vector("Base");
  const auto normal = object.vector("Normal");
  if (!base || !normal || glm::length(*normal) < kNowhere) {
    why = "it has no plane";
    return std::nullopt;
  }
  const auto solids = make_operands({object.link("Source")}, why);
  if (!solids) return std::nullopt;
  return maker_.place(object.placement() * mirror(*base, *normal),
                      solids->front());
}

// --- Extrusions -------------------------------------------------------------

const Outline* Reader::outline_of(std::string_view name, double error,
                                  std::string& why) {
  const Object* const object = document_.find(name);
  if (object == nullptr) {
    why = "it has no outline";
    return nullptr;
  }
  const auto [found, is_new] = outlines_.try_emplace({object, error});
  auto& [outline, its_why] = found->second;
  if (is_new) {
    outline = read_outline(*object, error, state_.corners, its_why);
    if (outline && outline->had_crossings) {
      model_.notes.push_back(
          fmt::format("outlines of '{}' cross each other, so what they "
                      "enclose is united",
                      object->label()));
    }
  }
  why = its_why;
  return outline ? &*outline : nullptr;
}

Reader::Made Reader::make_extrusion(const Object& object, std::string& why) {
  if (makes_surface(object)) {
    why = "it makes a surface, no solid";
    return std::nullopt;
  }
  if (object.number("TaperAngle", 0) != 0 ||
      object.number("TaperAngleRev", 0) != 0) {
    why = "it tapers";
    return std::nullopt;
  }
  const Outline* const outline =
      outline_of(object.link("Base"), maker_.chordal_error(), why);
  if (outline == nullptr) return std::nullopt;
  if (object.text("FaceMakerClass") == "Part::FaceMakerSimple" &&
      outline->contours.size() > 1) {
    why = "it fills each wire by itself";
    return std::nullopt;
  }
  constexpr int kByNormal = 2;
  constexpr int kByEdge = 1;
  Vec3 way = object.vector("Dir").value_or(Vec3(0));
  double length = object.number("LengthFwd", 0);
  double back = object.number("LengthRev", 0);
  if (std::abs(length) < kNowhere && std::abs(back) < kNowhere) {
    length = glm::length(way);
  }
  if (object.choice("DirMode") == kByEdge) {
    why = "an edge gives its direction";
    return std::nullopt;
  }
  if (object.choice("DirMode") == kByNormal) {
    way = apply_to_way(outline->plane, Vec3(0, 0, 1));
  }
  if (object.flag("Symmetric")) {
    back = length / 2;
    length /= 2;
  }
  if (object.flag("Reversed")) way = -way;
  const Vec3 normal = apply_to_way(outline->plane, Vec3(0, 0, 1));
  if (glm::length(way) < kNowhere ||
      std::abs(glm::dot(glm::normalize(way), normal)) < kSameWay ||
      std::abs(length + back) < kNowhere) {
    why = "it extrudes nowhere";
    return std::nullopt;
  }
  return maker_.place(object.placement(),
                      maker_.extrude(*outline, way, -back, length));
}

// --- Bodies of revolution ---------------------------------------------------

Reader::Made Reader::revolve(const Outline& outline, const Turn& spin,
                             std::string& why) {
  const Vec3 normal = apply_to_way(outline.plane, Vec3(0, 0, 1));
  const Vec3 origin = Vec3(outline.plane[3]);
  if (glm::length(spin.axis) < kNowhere || !(spin.angle_deg > 0)) {
    why = "it does not turn";
    return std::nullopt;
  }
  Vec3 z = glm::normalize(spin.axis);
  if (std::abs(glm::dot(z, normal)) > kSameWay ||
      std::abs(glm::dot(spin.base - origin, normal)) > kNowhere) {
    why = "its axis is not in the plane of its outline";
    return std::nullopt;
  }
  // Turning the other way about an axis is turning about its opposite.
  if (spin.is_reversed) z = -z;
  Vec3 x = glm::normalize(glm::cross(normal, z));
  std::vector<Polyline> contours = outline.contours;
  double low = 0;
  double high = 0;
  for (Polyline& contour : contours) {
    for (Vec2& corner : contour) {
      const Vec3 p = apply_to_point(outline.plane, Vec3(corner, 0)) - spin.base;
      corner = {glm::dot(p, x), glm::dot(p, z)};
      low = std::min(low, corner.x);
      high = std::max(high, corner.x);
    }
  }
  if (low < -kNowhere && high > kNowhere) {
    why = "its outline crosses its axis";
    return std::nullopt;
  }
  const double side = low < -kNowhere ? -1 : 1;
  x = side * x;
  for (Polyline& contour : contours) {
    for (Vec2& corner : contour) {
      corner.x = std::max(side * corner.x, 0.0);
      if (corner.x < kNowhere) corner.x = 0;
    }
  }
  Mat4 frame(1);
  frame[0] = Vec4(x, 0);
  frame[1] = Vec4(glm::cross(z, x), 0);
  frame[2] = Vec4(z, 0);
  frame[3] = Vec4(spin.base, 1);
  const double angle = std::min(spin.angle_deg, 360.0);
  if (spin.is_symmetric && angle < 360) {
    frame = frame * turn_about_z(-angle / 2);
  }
  return maker_.place(frame, maker_.revolve(contours, angle));
}

Reader::Made Reader::make_part_revolution(const Object& object,
                                          std::string& why) {
  if (makes_surface(object)) {
    why = "it makes a surface, no solid";
    return std::nullopt;
  }
  if (!object.sub_link("AxisLink").object.empty()) {
    why = "an edge gives its axis";
    return std::nullopt;
  }
  const Outline* const outline =
      outline_of(object.link("Source"), maker_.chordal_error_of_turned(), why);
  if (outline == nullptr) return std::nullopt;
  Turn spin;
  spin.base = object.vector("Base").value_or(Vec3(0));
  spin.axis = object.vector("Axis").value_or(Vec3(0, 0, 1));
  spin.angle_deg = std::abs(object.number("Angle"));
  spin.is_reversed = object.number("Angle") < 0;
  spin.is_symmetric = object.flag("Symmetric");
  const Made solid = revolve(*outline, spin, why);
  if (!solid) return std::nullopt;
  return maker_.place(object.placement(), *solid);
}

}  // namespace lamina::csg::freecad
