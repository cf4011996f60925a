#include "csg/minkowski/convex_leaf.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/convex_hull.h"
#include "csg/boundary/leaf_mesh.h"
#include "plane/predicates.h"
#include "plane/region/convex_faces.h"
#include "plane/region/minkowski.h"
#include "plane/region/region.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using Loop = std::vector<std::uint32_t>;

// A convex solid in leaf coordinates.
struct Draft {
  std::vector<Vec3> vertices;
  std::vector<Loop> loops;
};

Convex place(Draft draft, const Affine& matrix) {
  for (Vec3& vertex : draft.vertices) vertex = matrix * Vec4(vertex, 1);
  if (glm::dot(matrix[0], glm::cross(matrix[1], matrix[2])) < 0) {
    for (Loop& loop : draft.loops) std::reverse(loop.begin(), loop.end());
  }
  return make_solid(std::move(draft.vertices), draft.loops);
}

Draft draft_of(const Mesh& mesh) {
  Draft draft;
  draft.vertices = mesh.vertices;
  for (plane::Face& face :
       plane::merge_to_convex(mesh.vertices, mesh.triangles)) {
    draft.loops.push_back(std::move(face.corners));
  }
  return draft;
}

Draft draft_of(Loft loft) {
  Leaf leaf;
  leaf.lofts.push_back(std::move(loft));
  return draft_of(explicit_mesh(leaf));
}

// --- Extrusions --------------------------------------------------------------

bool is_extrusion(const Leaf& leaf) {
  return std::all_of(
      leaf.lofts.begin(), leaf.lofts.end(), [&](const Loft& loft) {
        return !loft.is_closed_profile && loft.profile.size() == 2 &&
               loft.profile == leaf.lofts[0].profile;
      });
}

std::vector<Draft> draft_extrusion(const Leaf& leaf) {
  plane::Region region;
  for (const Loft& loft : leaf.lofts) {
    Contour outline = *loft.outline;
    if (loft.is_cavity) std::reverse(outline.begin(), outline.end());
    region.contours.push_back(std::move(outline));
  }
  std::vector<Draft> drafts;
  for (Contour& piece : plane::cut_into_convex(region)) {
    drafts.push_back(
        draft_of({std::make_shared<const Contour>(std::move(piece)),
                  leaf.lofts[0].profile}));
  }
  return drafts;
}

// --- Bodies of revolution ----------------------------------------------------

// Whether the outline runs around the axis and never bends inwards.
bool is_convex_around_axis(const Contour& outline) {
  const std::size_t count = outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % count];
    const Vec2 c = outline[(i + 2) % count];
    if (cross(a, b) <= 0 || cross(b - a, c - b) <= 0) return false;
  }
  return true;
}

bool is_revolution(const Leaf& leaf) {
  const Contour& outline = *leaf.lofts[0].outline;
  return is_convex_around_axis(outline) &&
         std::all_of(
             leaf.lofts.begin(), leaf.lofts.end(),
             [&](const Loft& loft) { return *loft.outline == outline; });
}

// The profiles as a region of the plane of (scale, height).
plane::Region section_through_axis(const Leaf& leaf) {
  plane::Region region;
  for (const Loft& loft : leaf.lofts) {
    Contour contour = loft.profile;
    if (!loft.is_closed_profile) {
      if (contour.back().x > 0) contour.push_back({0, contour.back().y});
      if (contour.front().x > 0) contour.push_back({0, contour.front().y});
    }
    if (loft.is_cavity) std::reverse(contour.begin(), contour.end());
    region.contours.push_back(std::move(contour));
  }
  return region;
}

// Whether the piece reaches the axis at its lowest and its highest point.
bool spans_axis(const Contour& piece) {
  double low = piece[0].y;
  double high = piece[0].y;
  double axis_low = 1e300;
  double axis_high = -1e300;
  for (const Vec2 p : piece) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
    if (p.x > 0) continue;
    axis_low = std::min(axis_low, p.y);
    axis_high = std::max(axis_high, p.y);
  }
  return axis_low == low && axis_high == high;
}

// The whole turn of a piece that spans the axis.
Draft draft_turn(const Loft& whole, const Contour& piece) {
  // The profile begins behind the piece's side along the axis.
  std::size_t start = 0;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec2 before = piece[(i + piece.size() - 1) % piece.size()];
    if (before.x == 0 && piece[i].x == 0) start = i;
  }
  Loft loft;
  loft.outline = whole.outline;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    loft.profile.push_back(piece[(start + i) % piece.size()]);
  }
  // Flat ends are one polygon each.
  std::vector<Vec2>& profile = loft.profile;
  if (profile[0].y == profile[1].y) profile.erase(profile.begin());
  if (profile.back().y == profile[profile.size() - 2].y) profile.pop_back();
  return draft_of(std::move(loft));
}

// From one point of the outline to the next.
Draft draft_wedge(const Contour& piece, Vec2 from, Vec2 to) {
  Draft draft;
  Loop first;
  Loop second;
  for (const Vec2 p : piece) {
    first.push_back(static_cast<std::uint32_t>(draft.vertices.size()));
    draft.vertices.emplace_back(p.x * from.x, p.x * from.y, p.y);
    if (p.x > 0) draft.vertices.emplace_back(p.x * to.x, p.x * to.y, p.y);
    second.push_back(static_cast<std::uint32_t>(draft.vertices.size() - 1));
  }
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const std::size_t k = (i + 1) % piece.size();
    Loop side{first[i], second[i], second[k], first[k]};
    side.erase(std::unique(side.begin(), side.end()), side.end());
    if (side.front() == side.back()) side.pop_back();
    if (side.size() > 2) draft.loops.push_back(std::move(side));
  }
  draft.loops.push_back(first);
  std::reverse(second.begin(), second.end());
  draft.loops.push_back(std::move(second));
  return draft;
}

std::vector<Draft> draft_revolution(const Leaf& leaf) {
  const auto& outline = leaf.lofts[0].outline;
  std::vector<Draft> drafts;
  for (const Contour& piece :
       plane::cut_into_convex(section_through_axis(leaf))) {
    if (spans_axis(piece)) {
      drafts.push_back(draft_turn(leaf.lofts[0], piece));
      continue;
    }
    for (std::size_t i = 0; i < outline->size(); ++i) {
      drafts.push_back(draft_wedge(piece, (*outline)[i],
                                   (*outline)[(i + 1) % outline->size()]));
    }
  }
  return drafts;
}

}  // namespace

std::optional<std::vector<Convex>> convex_parts(const Leaf& leaf,
                                                const Affine& matrix) {
  std::vector<Convex> parts;
  if (leaf.meshes.empty() && (is_extrusion(leaf) || is_revolution(leaf))) {
    for (Draft& draft :
         is_extrusion(leaf) ? draft_extrusion(leaf) : draft_revolution(leaf)) {
      parts.push_back(place(std::move(draft), matrix));
    }
    return parts;
  }
  parts.push_back(place(draft_of(explicit_mesh(leaf)), matrix));
  if (leaf.is_convex || is_convex(parts[0])) return parts;
  return std::nullopt;
}

std::vector<Convex> flat_parts(const Leaf& leaf, const Affine& matrix) {
  std::vector<std::vector<Vec3>> solids;
  if (auto parts = convex_parts(leaf, Affine(1.0))) {
    for (Convex& part : *parts) solids.push_back(std::move(part.vertices));
  } else {
    // The image of a solid without volume is that of its surface.
    const Mesh mesh = explicit_mesh(leaf);
    for (const auto& t : mesh.triangles) {
      solids.push_back(
          {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    }
  }
  std::vector<Convex> flats;
  for (std::vector<Vec3>& points : solids) {
    for (Vec3& point : points) point = matrix * Vec4(point, 1);
    FlatHull hull = flat_hull(std::move(points));
    flats.push_back(make_flat(std::move(hull.corners), hull.normal));
  }
  return flats;
}

}  // namespace lamina::csg
