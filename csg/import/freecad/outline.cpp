#include "csg/import/freecad/detail/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/file/format_error.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

using std::numbers::pi;

// Solved constraints leave ends a little apart; FreeCAD itself joins ends
// within 1e-7 mm. [mm]
constexpr double kJoinDistance = 1e-6;

// --- Joining ----------------------------------------------------------------

// Ends of curves, in cells of twice the distance at which they join.
class CurveEnds {
 public:
  explicit CurveEnds(const std::vector<Polyline>& curves)
      : curves_(curves), is_taken_(2 * curves.size()) {
    for (std::uint32_t i = 0; i < curves.size(); ++i) {
      if (is_closed(curves[i])) continue;
      for (const bool is_end : {false, true}) {
        cells_[cell_of(point({i, is_end}))].push_back({i, is_end});
      }
    }
  }

  struct End {
    std::uint32_t curve;
    bool is_end;

    bool operator==(const End& other) const {
      return curve == other.curve && is_end == other.is_end;
    }
  };

  static bool is_closed(const Polyline& curve) {
    return curve.front() == curve.back();
  }

  Vec2 point(End end) const {
    const Polyline& curve = curves_[end.curve];
    return end.is_end ? curve.back() : curve.front();
  }

  // Takes the end nearest to the point, if one is near enough.
  std::optional<End> take_near(Vec2 place) {
    std::optional<End> best;
    double least = kJoinDistance;
    const Cell center = cell_of(place);
    // Its own cell first: an end at the very place is found at once.
    for (const int dx : {0, -1, 1}) {
      for (const int dy : {0, -1, 1}) {
        const auto cell = cells_.find({center[0] + dx, center[1] + dy});
        if (cell == cells_.end()) continue;
        std::vector<End>& ends = cell->second;
        for (std::size_t i = ends.size(); i-- > 0;) {
          const End end = ends[i];
          if (is_taken_[index(end)]) {
            ends[i] = ends.back();
            ends.pop_back();
            continue;
          }
          const double distance = glm::length(point(end) - place);
          if (distance == 0) {
            take(end);
            return end;
          }
          if (distance > least) continue;
          least = distance;
          best = end;
        }
      }
    }
    if (best) take(*best);
    return best;
  }

  void take(End end) { is_taken_[index(end)] = true; }

 private:
  using Cell = std::array<std::int64_t, 2>;

  static Cell cell_of(Vec2 place) {
    constexpr double kCell = 2 * kJoinDistance;
    return {static_cast<std::int64_t>(std::floor(place.x / kCell)),
            static_cast<std::int64_t>(std::floor(place.y / kCell))};
  }
  static std::size_t index(End end) {
    return 2 * std::size_t{end.curve} + (end.is_end ? 1 : 0);
  }

  const std::vector<Polyline>& curves_;
  std::vector<bool> is_taken_;
  std::map<Cell, std::vector<End>> cells_;
};

// Appends a curve that begins where the contour ends.
void append_curve(const Polyline& curve, bool is_reversed, Polyline& contour) {
  Polyline corners = curve;
  if (is_reversed) std::reverse(corners.begin(), corners.end());
  contour.insert(contour.end(), corners.begin() + (contour.empty() ? 0 : 1),
                 corners.end());
}

// --- Outlines ---------------------------------------------------------------

// Construction geometry helps to draw and is no part of the sketch.
bool is_construction(const pugi::xml_node& geometry) {
  if (geometry.child("Construction").attribute("value").as_bool()) return true;
  for (const pugi::xml_node extension :
       geometry.child("GeoExtensions").children("GeoExtension")) {
    // Bits, the lowest last; the second lowest says construction.
    const std::string_view flags =
        extension.attribute("geometryModeFlags").value();
    if (flags.size() > 1 && flags[flags.size() - 2] == '1') return true;
  }
  return false;
}

std::optional<std::vector<Polyline>> read_curves(const Object& sketch,
                                                 double error,
                                                 std::string& why) {
  std::vector<Polyline> curves;
  std::size_t corners = 0;
  for (const pugi::xml_node geometry :
       sketch.value("Geometry").children("Geometry")) {
    const std::string_view type = geometry.attribute("type").value();
    if (type == "Part::GeomPoint" || is_construction(geometry)) continue;
    auto curve = read_curve(geometry, error);
    if (!curve) {
      why = fmt::format("{} in '{}' is not known", type, sketch.label());
      return std::nullopt;
    }
    corners += curve->size();
    require_corners(corners);
    curves.push_back(std::move(*curve));
  }
  return curves;
}

std::optional<Outline> read_sketch(const Object& sketch, double error,
                                   std::string& why) {
  auto curves = read_curves(sketch, error, why);
  if (!curves) return std::nullopt;
  auto contours = join_curves(std::move(*curves));
  if (!contours || contours->empty()) {
    why = fmt::format("'{}' is not closed", sketch.label());
    return std::nullopt;
  }
  return Outline{sketch.placement(), std::move(*contours)};
}

// The corners of a closed polyline.
std::vector<Polyline> one_contour(Polyline chords) {
  chords.pop_back();
  return {std::move(chords)};
}

// Why there is no outline: one of these lengths is none.
bool are_lengths(const Object& object,
                 std::initializer_list<std::string_view> names,
                 std::string& why) {
  for (const std::string_view name : names) {
    if (object.number(name) > 0) continue;
    why = fmt::format("the {} of '{}' makes no outline", name, object.label());
    return false;
  }
  return true;
}

bool is_full(const Object& object) {
  return object.number("Angle1", 0) == 0 && object.number("Angle2", 360) == 360;
}

std::optional<Outline> read_regular_polygon(const Object& object,
                                            std::string& why) {
  if (!are_lengths(object, {"Circumradius"}, why)) return std::nullopt;
  const int corners = object.count("Polygon");
  if (corners < 3) {
    why = fmt::format("'{}' has {} sides", object.label(), corners);
    return std::nullopt;
  }
  require_fragments(corners);
  Polyline contour;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * i / corners;
    contour.push_back(object.number("Circumradius") *
                      Vec2(std::cos(angle), std::sin(angle)));
  }
  return Outline{object.placement(), {std::move(contour)}};
}

}  // namespace

std::optional<std::vector<Polyline>> join_curves(std::vector<Polyline> curves) {
  CurveEnds ends(curves);
  std::vector<bool> is_used(curves.size(), false);
  std::vector<Polyline> contours;
  for (std::uint32_t i = 0; i < curves.size(); ++i) {
    if (is_used[i]) continue;
    is_used[i] = true;
    Polyline contour = curves[i];
    if (!CurveEnds::is_closed(curves[i])) {
      // Go on from the end until the contour is back at its begin.
      ends.take({i, true});
      CurveEnds::End last = {i, true};
      for (;;) {
        const auto next = ends.take_near(ends.point(last));
        if (!next) return std::nullopt;
        if (*next == CurveEnds::End{i, false}) break;
        is_used[next->curve] = true;
        append_curve(curves[next->curve], next->is_end, contour);
        last = {next->curve, !next->is_end};
        ends.take(last);
      }
    }
    contour.pop_back();
    require_corners(contour.size());
    if (contour.size() > 2) contours.push_back(std::move(contour));
  }
  return contours;
}

std::optional<Outline> read_outline(const Object& object, double error,
                                    std::string& why) {
  if (object.type().starts_with("Sketcher::SketchObject")) {
    return read_sketch(object, error, why);
  }
  if (object.is_a("Part::RegularPolygon")) {
    return read_regular_polygon(object, why);
  }
  if (object.is_a("Part::Plane")) {
    if (!are_lengths(object, {"Length", "Width"}, why)) return std::nullopt;
    const Vec2 size(object.number("Length"), object.number("Width"));
    return Outline{object.placement(),
                   {{{0, 0}, {size.x, 0}, size, {0, size.y}}}};
  }
  if (object.is_a("Part::Circle") && is_full(object)) {
    if (!are_lengths(object, {"Radius"}, why)) return std::nullopt;
    return Outline{object.placement(),
                   one_contour(arc(object.number("Radius"), 0, 2 * pi, error))};
  }
  if (object.is_a("Part::Ellipse") && is_full(object)) {
    if (!are_lengths(object, {"MajorRadius", "MinorRadius"}, why)) {
      return std::nullopt;
    }
    const Vec2 radii(object.number("MajorRadius"),
                     object.number("MinorRadius"));
    return Outline{object.placement(),
                   one_contour(elliptic_arc(radii, 0, 2 * pi, error))};
  }
  why = fmt::format("'{}' is a {}", object.label(), object.type());
  return std::nullopt;
}

std::vector<Vec2> circle_centers(const Object& sketch) {
  std::vector<Vec2> centers;
  for (const pugi::xml_node geometry :
       sketch.value("Geometry").children("Geometry")) {
    if (is_construction(geometry)) continue;
    for (const char* const kind : {"Circle", "ArcOfCircle"}) {
      const pugi::xml_node circle = geometry.child(kind);
      if (!circle) continue;
      centers.emplace_back(read_number(circle, "CenterX"),
                           read_number(circle, "CenterY"));
    }
  }
  return centers;
}

}  // namespace lamina::csg::freecad
