// Features of FreeCAD's workbench PartDesign.
//
// A body is a chain: each feature adds its tool to the feature before, or takes
// it away. The features stand in the frame of the body, and so do the sketches
// that are their profiles.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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
  const Object* const tip = document_.find(object.link("Tip"));
  if (tip == nullptr) {
    why = "it has no tip";
    return std::nullopt;
  }
  const Made solid = make(*tip);
  if (!solid) {
    const std::string& its_why = entries_[tip].why;
    why = fmt::format("its tip '{}' is no solid{}{}", tip->label(),
                      its_why.empty() ? "" : ": ", its_why);
    return std::nullopt;
  }
  return maker_.place(object.placement(), *solid);
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
  const auto [found, is_new] = tools_.try_emplace(&object);
  Entry& entry = found->second;
  if (is_new) entry.solid = make_tool_anew(object, entry.why);
  why = entry.why;
  return entry.solid;
}

Reader::Made Reader::make_tool_anew(const Object& object, std::string& why) {
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
  if (type == "PartDesign::Hole") return make_hole_tool(object, why);
  for (const std::string_view prefix :
       {"PartDesign::Additive", "PartDesign::Subtractive"}) {
    if (!type.starts_with(prefix)) continue;
    const Made solid =
        make_primitive(type.substr(prefix.size()), object, maker_, why);
    if (!solid) return std::nullopt;
    return maker_.place(object.placement(), *solid);
  }
  why = fmt::format("'{}' is a {}", object.label(), type);
  return std::nullopt;
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

// --- Hole -------------------------------------------------------------------

namespace {

enum HoleCut { kNoCut = 0, kCounterbore = 1, kCountersink = 2 };

// The profile of a hole as (radius, depth below the sketch), from the axis
// above to the axis below. Nothing where a part of it has no plain form.
std::optional<Polyline> hole_profile(const Object& hole, std::string& why) {
  using std::numbers::pi;
  if (hole.flag("Tapered")) {
    why = "it tapers";
    return std::nullopt;
  }
  if (hole.flag("ModelThread") || hole.flag("ModelActualThread")) {
    why = "it has a thread";
    return std::nullopt;
  }
  const double radius = hole.number("Diameter") / 2;
  const bool is_through = hole.choice("DepthType") == 1;
  const double depth = is_through ? kThroughAll : hole.number("Depth");
  Polyline profile = {{0, 0}};
  const double cut_radius = hole.number("HoleCutDiameter", 0) / 2;
  const double cut_depth = hole.number("HoleCutDepth", 0);
  switch (hole.choice("HoleCutType")) {
    case kNoCut:
      profile.emplace_back(radius, 0);
      break;
    case kCounterbore:
      profile.emplace_back(cut_radius, 0);
      profile.emplace_back(cut_radius, cut_depth);
      profile.emplace_back(radius, cut_depth);
      break;
    case kCountersink: {
      const double half = hole.number("HoleCutCountersinkAngle") / 2;
      profile.emplace_back(cut_radius, 0);
      profile.emplace_back(radius,
                           (cut_radius - radius) / std::tan(half * pi / 180));
      break;
    }
    default:
      why = "its cut has a form of a standard";
      return std::nullopt;
  }
  profile.emplace_back(radius, depth);
  if (hole.choice("DrillPoint") == 1 && !is_through) {
    const double half = hole.number("DrillPointAngle") / 2;
    const double tip = radius / std::tan(half * pi / 180);
    if (hole.flag("DrillForDepth")) {
      profile.back().y -= tip;
      profile.emplace_back(0, depth);
    } else {
      profile.emplace_back(0, depth + tip);
    }
  } else {
    profile.emplace_back(0, depth);
  }
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const bool goes_down = profile[i].y >= profile[i - 1].y;  // no NaN does
    if (!(profile[i].x >= 0) || !goes_down || plane::is_too_far(profile[i].y)) {
      why = "its measures make no hole";
      return std::nullopt;
    }
  }
  return profile;
}

}  // namespace

Reader::Made Reader::make_hole_tool(const Object& object, std::string& why) {
  const SubLink link = object.sub_link("Profile");
  const Object* const sketch = document_.find(link.object);
  if (sketch == nullptr || !sketch->type().starts_with("Sketcher::") ||
      !link.subs.empty()) {
    why = "its profile is no sketch";
    return std::nullopt;
  }
  if (object.value("BaseProfileType")) {
    why = "it chooses among circles, arcs and points, as newer FreeCAD does";
    return std::nullopt;
  }
  auto profile = hole_profile(object, why);
  if (!profile) return std::nullopt;
  const std::vector<Vec2> centers = circle_centers(*sketch);
  if (centers.empty()) {
    why = "its sketch has no circle";
    return std::nullopt;
  }
  if (!object.flag("Reversed")) {
    for (Vec2& corner : *profile) corner.y = -corner.y;
  }
  const Solid hole = maker_.revolve({*profile}, 360);
  std::vector<Solid> holes;
  holes.reserve(centers.size());
  for (const Vec2 center : centers) {
    holes.push_back(
        maker_.place(sketch->placement() * shift(Vec3(center, 0)), hole));
  }
  return maker_.unite(holes);
}

}  // namespace lamina::csg::freecad
