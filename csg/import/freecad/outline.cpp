#include "csg/import/freecad/detail/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/union_find.h"
#include "csg/limits.h"
#include "plane/edge_tree.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"

namespace lamina::csg::freecad {
namespace {

// Solved constraints leave ends a little apart; FreeCAD itself joins ends
// within 1e-7 mm. [mm]
constexpr double kJoinDistance = 1e-6;

// --- Joining ----------------------------------------------------------------

// Ends of curves, by the vertex at which they join. Vertices are farther apart
// than the distance at which ends join, so that a cell has a few of them,
// however many ends crowd there.
class CurveEnds {
 public:
  explicit CurveEnds(const std::vector<Polyline>& curves)
      : vertex_of_(2 * curves.size()), is_taken_(2 * curves.size()) {
    for (std::uint32_t i = 0; i < curves.size(); ++i) {
      if (is_closed(curves[i])) continue;
      add({i, false}, curves[i].front());
      add({i, true}, curves[i].back());
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

  // Takes an end that joins this one, if one is left.
  std::optional<End> take_joined(End end) {
    std::vector<End>& ends = vertices_[vertex_of_[index(end)]].ends;
    while (!ends.empty()) {
      const End next = ends.back();
      ends.pop_back();
      if (is_taken_[index(next)]) continue;
      take(next);
      return next;
    }
    return std::nullopt;
  }

  void take(End end) { is_taken_[index(end)] = true; }

 private:
  using Cell = std::array<std::int64_t, 2>;

  struct Vertex {
    Vec2 place;
    std::vector<End> ends;
  };

  static Cell cell_of(Vec2 place) {
    constexpr double kCell = 2 * kJoinDistance;
    return {static_cast<std::int64_t>(std::floor(place.x / kCell)),
            static_cast<std::int64_t>(std::floor(place.y / kCell))};
  }
  static std::size_t index(End end) {
    return 2 * std::size_t{end.curve} + (end.is_end ? 1 : 0);
  }

  void add(End end, Vec2 place) {
    const std::size_t vertex = vertex_at(place);
    vertices_[vertex].ends.push_back(end);
    vertex_of_[index(end)] = vertex;
  }

  // The nearest vertex that is near enough, else a new one.
  std::size_t vertex_at(Vec2 place) {
    const Cell center = cell_of(place);
    std::optional<std::size_t> best;
    double least = kJoinDistance;
    for (const int dx : {-1, 0, 1}) {
      for (const int dy : {-1, 0, 1}) {
        const auto cell = cells_.find({center[0] + dx, center[1] + dy});
        if (cell == cells_.end()) continue;
        for (const std::size_t vertex : cell->second) {
          const double distance = glm::length(vertices_[vertex].place - place);
          if (distance > least) continue;
          least = distance;
          best = vertex;
        }
      }
    }
    if (best) return *best;
    vertices_.push_back({place, {}});
    cells_[center].push_back(vertices_.size() - 1);
    return vertices_.size() - 1;
  }

  std::vector<Vertex> vertices_;
  std::vector<std::size_t> vertex_of_;  // by the index of an end
  std::vector<bool> is_taken_;          // likewise
  std::map<Cell, std::vector<std::size_t>> cells_;
};

// Appends a curve that begins where the contour ends.
void append_curve(const Polyline& curve, bool is_reversed, Polyline& contour) {
  Polyline corners = curve;
  if (is_reversed) std::reverse(corners.begin(), corners.end());
  contour.insert(contour.end(), corners.begin() + (contour.empty() ? 0 : 1),
                 corners.end());
}

// --- Crossings --------------------------------------------------------------

using LoopPair = std::pair<std::uint32_t, std::uint32_t>;

// Whether edges of the contours cross: where they do, what an odd number of
// them surrounds has corners that none of them has.
bool have_crossings(const std::vector<Polyline>& contours) {
  const auto region =
      plane::from_few_crossings(contours, plane::FillRule::kEvenOdd);
  if (!region) return true;
  std::vector<Vec2> corners;
  for (const Polyline& contour : contours) {
    corners.insert(corners.end(), contour.begin(), contour.end());
  }
  std::ranges::sort(corners, precedes);
  return std::ranges::any_of(region->contours, [&](const Polyline& contour) {
    return std::ranges::any_of(contour, [&](Vec2 corner) {
      return !std::ranges::binary_search(corners, corner, precedes);
    });
  });
}

// Whether the segments cross or touch.
bool do_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return orientation(a, b, c) * orientation(a, b, d) <= 0 &&
         orientation(c, d, a) * orientation(c, d, b) <= 0;
}

// The contours of which an edge meets one of the other, all that cross among
// them.
std::set<LoopPair> meeting_pairs(const std::vector<Polyline>& contours) {
  plane::Contours loops;
  for (const Polyline& contour : contours) loops.add_loop(contour);
  const plane::EdgeTree edges(loops);
  std::set<LoopPair> pairs;
  // Each a second's work: bundles of edges to look at, and regions to cut.
  constexpr std::size_t kMostLooks = 10'000'000;
  constexpr std::size_t kMostPairs = 100'000;
  std::size_t looks = 0;
  const auto look = [&](const plane::EdgeTree::Bundle& a,
                        const plane::EdgeTree::Bundle& b) {
    if (++looks > kMostLooks || pairs.size() > kMostPairs) {
      throw plane::LimitExceeded(
          "Too many outlines of a sketch cross or surround each other");
    }
    if (a.loop == b.loop) return false;
    const LoopPair pair = std::minmax(a.loop, b.loop);
    if (pairs.contains(pair)) return false;
    for (std::uint32_t i = a.begin; i < a.end; ++i) {
      for (std::uint32_t k = b.begin; k < b.end; ++k) {
        if (do_meet(edges.from(i), edges.to(i), edges.from(k), edges.to(k))) {
          pairs.insert(pair);
        }
      }
    }
    return false;
  };
  edges.visit_near(0, look, plane::EdgeTree::Crowd::kVisit);
  return pairs;
}

// --- Outlines ---------------------------------------------------------------

// Construction geometry helps to draw and is not part of the sketch.
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
                                                 std::size_t& corners,
                                                 std::string& why) {
  std::vector<Polyline> curves;
  for (const pugi::xml_node geometry :
       sketch.value("Geometry").children("Geometry")) {
    const std::string_view type = geometry.attribute("type").value();
    if (type == "Part::GeomPoint" || is_construction(geometry)) continue;
    auto curve = read_curve(geometry, error);
    if (!curve) {
      why = fmt::format("'{}' has a {}", sketch.label(), type);
      return std::nullopt;
    }
    plane::require_corners(corners += curve->size() - 1);
    curves.push_back(std::move(*curve));
  }
  return curves;
}

}  // namespace

bool unite_crossing(double error, std::vector<Polyline>& contours) {
  if (contours.size() < 2 || !have_crossings(contours)) return false;
  std::map<std::uint32_t, plane::Region> regions;  // of those that may cross
  const auto region_of = [&](std::uint32_t i) -> const plane::Region& {
    const auto [found, is_new] = regions.try_emplace(i);
    if (is_new) found->second = plane::from_contours({&contours[i], 1});
    return found->second;
  };
  UnionFind sets(contours.size());
  bool has_crossings = false;
  for (const auto& [i, k] : meeting_pairs(contours)) {
    const std::array<plane::Region, 2> both = {region_of(i), region_of(k)};
    const double common = area(plane::intersect(both));
    const double least = std::min(area(both[0]), area(both[1]));
    const double slack =
        error * std::min(perimeter(contours[i]), perimeter(contours[k]));
    if (std::min(common, least - common) <= slack) continue;
    sets.unite(i, k);
    has_crossings = true;
  }
  if (!has_crossings) return false;
  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < contours.size(); ++i) {
    members[sets.find(i)].push_back(i);
  }
  std::vector<Polyline> result;
  for (const auto& [set, its_members] : members) {
    if (its_members.size() == 1) {
      result.push_back(std::move(contours[set]));
      continue;
    }
    std::vector<plane::Region> faces;
    for (const std::uint32_t i : its_members) faces.push_back(region_of(i));
    plane::Region region = plane::unite(faces);
    std::move(region.contours.begin(), region.contours.end(),
              std::back_inserter(result));
  }
  contours = std::move(result);
  return true;
}

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
        const auto next = ends.take_joined(last);
        if (!next) return std::nullopt;
        if (*next == CurveEnds::End{i, false}) break;
        is_used[next->curve] = true;
        append_curve(curves[next->curve], next->is_end, contour);
        last = {next->curve, !next->is_end};
        ends.take(last);
      }
    }
    contour.pop_back();
    if (contour.size() > 2) contours.push_back(std::move(contour));
  }
  return contours;
}

std::optional<Outline> read_outline(const Object& sketch, double error,
                                    std::size_t& corners, std::string& why) {
  if (!sketch.type().starts_with("Sketcher::SketchObject")) {
    why = fmt::format("'{}' is a {}", sketch.label(), sketch.type());
    return std::nullopt;
  }
  auto curves = read_curves(sketch, error, corners, why);
  if (!curves) return std::nullopt;
  auto contours = join_curves(std::move(*curves));
  if (!contours || contours->empty()) {
    why = fmt::format("'{}' is not closed", sketch.label());
    return std::nullopt;
  }
  Outline outline{sketch.placement(), std::move(*contours)};
  outline.had_crossings = unite_crossing(error, outline.contours);
  return outline;
}

}  // namespace lamina::csg::freecad
