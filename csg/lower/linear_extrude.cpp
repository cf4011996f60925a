// linear_extrude: lofts where sides are planar, a mesh where they are not.
//
// A twisted side is a quad that no plane holds, so the choice of its diagonal
// is part of the shape. OpenSCAD 2021.01 takes the shorter one and, between
// equal ones, the one that follows the twist; the same is done here, so that
// both programs mean the same solid.

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

#include "csg/degrees.h"
#include "csg/limits.h"
#include "csg/lower/detail/extrude.h"
#include "csg/lower/detail/fineness.h"
#include "csg/lower/detail/split_contours.h"
#include "plane/loop_area.h"
#include "plane/region/triangulate.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using plane::Region;

// Diagonals are equal where they differ by less than this share: rounding
// must not choose.
constexpr double kEqualDiagonals = 1e-5;

// The greatest length of f(point) over the region's points.
template <typename F>
double greatest_length(const Region& region, F f) {
  double greatest = 0;
  for (const Contour& contour : region.contours) {
    for (const Vec2 p : contour)
      greatest = std::max(greatest, glm::length(f(p)));
  }
  return greatest;
}

// Into how many parts an edge is cut, none longer than this; 0: it stays whole.
double part_count(Vec2 edge, double longest) {
  return longest == 0 ? 1
                      : std::max(std::ceil(glm::length(edge) / longest), 1.0);
}

Vec2 edge_at(const Contour& contour, std::size_t i) {
  return contour[(i + 1) % contour.size()] - contour[i];
}

// How many triangles the sides have, once edges are split.
double triangle_count(const Region& region, const ExtrusionSteps& steps) {
  double points = 0;
  for (const Contour& contour : region.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      points += part_count(edge_at(contour, i), steps.longest_edge);
    }
  }
  return 2 * points * steps.slices;
}

// Adds points to the region so that no edge is longer than this; 0: adds none.
Region split_edges(const Region& region, double longest) {
  if (longest == 0) return region;
  Region split;
  for (const Contour& contour : region.contours) {
    Contour& points = split.contours.emplace_back();
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 begin = contour[i];
      const Vec2 edge = edge_at(contour, i);
      const double parts = part_count(edge, longest);
      for (std::size_t k = 0; static_cast<double>(k) < parts; ++k) {
        points.push_back(begin + edge * (static_cast<double>(k) / parts));
      }
    }
  }
  return split;
}

Leaf loft_contours(const Region& region, double low, double high,
                   double scale) {
  Leaf leaf;
  for (const Contour& contour : region.contours) {
    const bool is_hole = sliver_area(contour) < 0;
    auto outline = std::make_shared<std::vector<Vec2>>(contour);
    if (is_hole) std::reverse(outline->begin(), outline->end());
    leaf.lofts.push_back(
        {std::move(outline), {{1, low}, {scale, high}}, false, is_hole});
  }
  return leaf;
}

// One height of a twisted extrusion: turned, then scaled.
struct Slice {
  double rotation_deg = 0;
  double z = 0;
  Vec2 scale{1};

  Vec3 place(Vec2 p) const {
    const double s = sin_deg(-rotation_deg);
    const double c = cos_deg(-rotation_deg);
    return {scale.x * c * p.x - scale.x * s * p.y,
            scale.y * s * p.x + scale.y * c * p.y, z};
  }
};

int compare_diagonals(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const double ab = glm::length(Vec2(a) - Vec2(b));
  const double cd = glm::length(Vec2(c) - Vec2(d));
  if (2 * std::abs(ab - cd) <= kEqualDiagonals * (ab + cd)) return 0;
  return ab < cd ? -1 : 1;
}

class TwistedExtruder {
 public:
  TwistedExtruder(const LinearExtrudeParams& params, const Region& region,
                  double low, int slices)
      : params_(params), region_(region), low_(low), slices_(slices) {}

  Mesh extrude() {
    for (int i = 0; i <= slices_; ++i) add_ring(slice_at(i));
    std::uint32_t first = 0;
    for (const Contour& contour : region_.contours) {
      const bool is_hole = sliver_area(contour) < 0;
      for (int i = 0; i < slices_; ++i) {
        add_band(i, first, static_cast<std::uint32_t>(contour.size()), is_hole);
      }
      first += static_cast<std::uint32_t>(contour.size());
    }
    add_caps();
    return std::move(mesh_);
  }

 private:
  Slice slice_at(int i) const {
    return {params_.twist_deg * i / slices_,
            low_ + params_.height * i / slices_,
            Vec2(1 - (1 - params_.scale.x) * i / slices_,
                 1 - (1 - params_.scale.y) * i / slices_)};
  }

  // A ring scaled to nothing is an apex: one vertex for all of the contours.
  bool is_apex(int ring) const {
    return ring == slices_ && params_.scale == Vec2(0);
  }

  void add_ring(const Slice& slice) {
    ring_begins_.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (slice.scale == Vec2(0)) {
      mesh_.vertices.push_back({0, 0, slice.z});
      return;
    }
    for (const Contour& contour : region_.contours) {
      for (const Vec2 point : contour) {
        mesh_.vertices.push_back(slice.place(point));
      }
    }
  }

  std::uint32_t vertex(int ring, std::uint32_t point) const {
    const auto i = static_cast<std::size_t>(ring);
    return ring_begins_[i] + (is_apex(ring) ? 0 : point);
  }

  void add_band(int ring, std::uint32_t first, std::uint32_t count,
                bool is_hole) {
    const bool turns_back =
        slice_at(ring + 1).rotation_deg <= slice_at(ring).rotation_deg;
    const bool prefers_rising = is_hole == turns_back;
    const Vec2 upper_scale = slice_at(ring + 1).scale;
    const bool is_pinched = upper_scale.x == 0 || upper_scale.y == 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t j = (i + 1) % count;
      const std::uint32_t a = vertex(ring, first + i);
      const std::uint32_t b = vertex(ring, first + j);
      const std::uint32_t c = vertex(ring + 1, first + j);
      const std::uint32_t d = vertex(ring + 1, first + i);
      if (c == d) {
        mesh_.triangles.push_back({a, b, c});
        continue;
      }
      const auto& v = mesh_.vertices;
      const int order = compare_diagonals(v[a], v[c], v[b], v[d]);
      const bool is_rising = order < 0 || (order == 0 && prefers_rising);
      if (is_rising != is_pinched) {
        mesh_.triangles.push_back({a, b, c});
        mesh_.triangles.push_back({a, c, d});
      } else {
        mesh_.triangles.push_back({a, b, d});
        mesh_.triangles.push_back({b, c, d});
      }
    }
  }

  // The top is the bottom's triangulation moved up. An extrusion that ends in
  // a line keeps it, flat as it is: it closes the mesh.
  void add_caps() {
    for (const auto& t : plane::triangulate(region_)) {
      mesh_.triangles.push_back(
          {vertex(0, t[0]), vertex(0, t[2]), vertex(0, t[1])});
      if (is_apex(slices_)) continue;
      mesh_.triangles.push_back({vertex(slices_, t[0]), vertex(slices_, t[1]),
                                 vertex(slices_, t[2])});
    }
  }

  const LinearExtrudeParams& params_;
  const Region& region_;
  const double low_;
  const int slices_;
  Mesh mesh_;
  std::vector<std::uint32_t> ring_begins_;
};

}  // namespace

Leaf extrude_linearly(const LinearExtrudeParams& params, const Region& region,
                      const Fineness& fineness) {
  const double height = params.height;
  if (!(height > 0) || !std::isfinite(height) || region.is_empty()) return {};
  const double low = params.center ? -height / 2 : 0;
  const double high = params.center ? height / 2 : height;
  if (!params.has_twist && params.scale.x == params.scale.y) {
    return loft_contours(region, low, high, params.scale.x);
  }
  const double radius = greatest_length(region, [](Vec2 p) { return p; });
  const double shift =
      greatest_length(region, [&](Vec2 p) { return p - p * params.scale; });
  const ExtrusionSteps steps = extrusion_steps(params, radius, shift, fineness);
  require_triangles(triangle_count(region, steps));
  const Region outline =
      fineness.is_by_error() && !params.segments
          ? split_edges(region, steps.longest_edge)
          : split_contours(region, params, steps.slices, fineness.language);
  require_triangles(triangle_count(outline, {steps.slices}));
  Leaf leaf;
  leaf.meshes.push_back(
      TwistedExtruder(params, outline, low, steps.slices).extrude());
  // A slice that turns far can have sides that cut each other.
  leaf.may_overlap_itself = true;
  return leaf;
}

}  // namespace lamina::csg
