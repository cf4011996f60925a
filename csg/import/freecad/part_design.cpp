// Features of FreeCAD's workbench PartDesign.
//
// A body is a chain: each feature adds its tool to the feature before, or takes
// it away. The features stand in the frame of the body, and so do the sketches
// that are their profiles.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csg/import/freecad/detail/primitives.h"
#include "csg/import/freecad/detail/reader.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

// Far beyond all parts that are made, where FreeCAD goes a little beyond the
// part in hand [mm].
constexpr double kThroughAll = 1e5;

// Lengths and sines below it are none.
constexpr double kLeast = 1e-7;

// The types of Pad and Pocket, of which 1 to 3 end at a face of the body but
// for Pocket's 1.
enum ExtrusionType { kLength = 0, kThrough = 1, kTwoLengths = 4 };

}  // namespace

// --- Chains -----------------------------------------------------------------

Reader::Made Reader::make_body(const Object& object, std::string& why) {
  std::vector<Solid> solids;
  const Object* const tip = document_.find(object.link("Tip"));
  if (tip != nullptr) {
    if (const Made solid = make(*tip)) {
      solids.push_back(*solid);
    } else {
      const std::string& its_why = entries_[tip].why;
      why = fmt::format("its tip '{}' is no solid{}{}", tip->label(),
                        its_why.empty() ? "" : ": ", its_why);
      return std::nullopt;
    }
  }
  for (const std::string_view name : members_of(object)) {
    const Object* const member = document_.find(name);
    if (member == nullptr || member == tip || !member->is_visible() ||
        !is_binder(*member)) {
      continue;
    }
    if (const Made solid = make(*member)) solids.push_back(*solid);
  }
  if (solids.empty()) {
    why = "it has no tip";
    return std::nullopt;
  }
  return maker_.place(object.placement(), maker_.unite(solids));
}

Reader::Made Reader::make_base(const Object& object, std::string& why) {
  const std::string_view name = object.link("BaseFeature");
  const auto base = make_operands({name}, why);
  if (!base) return std::nullopt;
  // The body takes the base as it is before its own placement.
  const Mat4 base_from_holder = glm::inverse(document_.find(name)->placement());
  return maker_.place(object.placement() * base_from_holder, base->front());
}

Reader::Made Reader::make_body_boolean(const Object& object, std::string& why) {
  enum Type { kFuse, kCut, kCommon };
  std::vector<std::string_view> names = {object.link("BaseFeature")};
  const auto others = object.links("Group");
  if (names.front().empty()) names.clear();
  names.insert(names.end(), others.begin(), others.end());
  const auto solids = make_operands(names, why);
  if (!solids) return std::nullopt;
  switch (object.choice("Type")) {
    case kFuse:
      return maker_.unite(*solids);
    case kCut:
      return maker_.subtract(*solids);
    case kCommon:
      return maker_.intersect(*solids);
    default:
      why = "its type is not known";
      return std::nullopt;
  }
}

Reader::Made Reader::make_feature(const Object& object, std::string& why) {
  if (!object.value("BaseFeature")) {
    why = "it is of an older FreeCAD";
    return std::nullopt;
  }
  const Made tool = make_tool(object, why);
  if (!tool) return std::nullopt;
  const std::string_view base_name = object.link("BaseFeature");
  if (base_name.empty()) {
    if (adds(object)) return tool;
    why = "there is nothing to take it from";
    return std::nullopt;
  }
  const Made base = make(base_name);
  if (!base) {
    why = fmt::format("'{}' is no solid", base_name);
    return std::nullopt;
  }
  const std::array<Solid, 2> operands = {*base, *tool};
  return adds(object) ? maker_.unite(operands) : maker_.subtract(operands);
}

bool Reader::adds(const Object& object) {
  const std::string_view type = object.type();
  return type == "PartDesign::Pad" || type == "PartDesign::Revolution" ||
         type.starts_with("PartDesign::Additive");
}

Reader::Made Reader::make_tool(const Object& object, std::string& why) {
  const std::string_view type = object.type();
  if (object.flag("Suppressed")) {
    why = "it is suppressed";
    return std::nullopt;
  }
  if (type == "PartDesign::Pad" || type == "PartDesign::Pocket") {
    return make_prism_tool(object, why);
  }
  if (type == "PartDesign::Revolution" || type == "PartDesign::Groove") {
    return make_revolution_tool(object, why);
  }
  const std::string_view prefix =
      adds(object) ? "PartDesign::Additive" : "PartDesign::Subtractive";
  const Made solid =
      make_primitive(type.substr(prefix.size()), object, maker_, why);
  if (!solid) return std::nullopt;
  return maker_.place(object.placement(), *solid);
}

const Outline* Reader::profile_of(const Object& object, double error,
                                  std::string& why) {
  const SubLink profile = object.sub_link("Profile");
  if (!profile.subs.empty()) {
    why = "its profile is a part of a shape";
    return nullptr;
  }
  return outline_of(profile.object, error, why);
}

// --- Pad and Pocket ---------------------------------------------------------

Reader::Made Reader::make_prism_tool(const Object& object, std::string& why) {
  const Outline* const outline =
      profile_of(object, maker_.chordal_error(), why);
  if (outline == nullptr) return std::nullopt;
  if (object.number("TaperAngle", 0) != 0 ||
      object.number("TaperAngle2", 0) != 0) {
    why = "it tapers";
    return std::nullopt;
  }
  if (object.choice("SideType") != 0) {
    why = "it has two sides, as newer FreeCAD says it";
    return std::nullopt;
  }
  const bool is_pocket = !adds(object);
  const int type = object.choice("Type");
  if (type != kLength && type != kTwoLengths &&
      !(type == kThrough && is_pocket)) {
    why = "it ends at a face";
    return std::nullopt;
  }
  const Vec3 normal = apply_to_way(outline->plane, Vec3(0, 0, 1));
  // Pockets go into the body, which is below their sketch.
  Vec3 way = is_pocket ? -normal : normal;
  const bool has_way = object.flag("UseCustomVector") ||
                       !object.sub_link("ReferenceAxis").object.empty();
  if (const auto custom = object.vector("Direction"); custom && has_way) {
    if (glm::length(*custom) > kLeast) way = glm::normalize(*custom);
  }
  const double slope = std::abs(glm::dot(way, normal));
  if (slope < kLeast) {
    why = "its direction lies in its sketch";
    return std::nullopt;
  }
  double length = object.number("Length");
  double back = type == kTwoLengths ? object.number("Length2") : 0;
  if (object.flag("AlongSketchNormal")) {
    length /= slope;
    back /= slope;
  }
  if (type == kThrough) length = kThroughAll;
  if (object.flag("Midplane") && type != kTwoLengths) {
    if (type != kThrough) length /= 2;
    back = length;
  }
  if (object.flag("Reversed")) way = -way;
  if (std::abs(length + back) < kLeast) {
    why = "it has no length";
    return std::nullopt;
  }
  return maker_.extrude(*outline, way, -back, length);
}

// --- Revolution and Groove --------------------------------------------------

Reader::Made Reader::make_revolution_tool(const Object& object,
                                          std::string& why) {
  const Outline* const outline =
      profile_of(object, maker_.chordal_error_of_turned(), why);
  if (outline == nullptr) return std::nullopt;
  if (object.choice("Type") != 0) {
    why = "it ends at a face or has two angles";
    return std::nullopt;
  }
  Turn spin;
  spin.base = object.vector("Base").value_or(Vec3(0));
  spin.axis = object.vector("Axis").value_or(Vec3(0, 1, 0));
  spin.angle_deg = object.number("Angle");
  spin.is_symmetric = object.flag("Midplane");
  spin.is_reversed = object.flag("Reversed") && !spin.is_symmetric;
  return revolve(*outline, spin, why);
}

}  // namespace lamina::csg::freecad
