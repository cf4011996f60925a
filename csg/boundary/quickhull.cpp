#include "csg/boundary/detail/quickhull.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>

#include "csg/boundary/detail/orientation.h"

namespace lamina::csg {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// A triangle, counter-clockwise from outside.
struct Facet {
  std::array<std::uint32_t, 3> corners{};
  // Across the edge from each corner to the next one.
  std::array<std::uint32_t, 3> neighbours{};
  OrientedPlane plane;
  // The outside set is a list, the farthest point first.
  std::uint32_t outside = kNone;
  double height = 0;  // of the first
  bool is_gone = false;

  // Which of the edges begins at the corner.
  std::size_t edge_from(std::uint32_t corner) const {
    return corners[0] == corner ? 0 : corners[1] == corner ? 1 : 2;
  }
};

// An edge of a facet.
struct Edge {
  std::uint32_t facet = 0;
  std::size_t index = 0;
};

class Quickhull {
 public:
  explicit Quickhull(std::span<const Vec3> points)
      : points_(points), next_(points.size()), cone_at_(points.size()) {
    Box3 box;
    box.add(points);
    extent_ = box.size();
  }

  // a, b, c, d  span a volume; d lies below a, b, c
  void start(std::uint32_t a, std::uint32_t b, std::uint32_t c,
             std::uint32_t d) {
    // A triangle of two faces becomes the simplex.
    make_facet({a, b, c});
    make_facet({a, c, b});
    facets_[0].neighbours = {1, 1, 1};
    facets_[1].neighbours = {0, 0, 0};
    add_corner(d, 1);
    for (std::uint32_t point = 0; point < points_.size(); ++point) {
      const auto visible = std::find_if(
          cone_.begin(), cone_.end(),
          [&](std::uint32_t facet) { return side(facet, point) > 0; });
      if (visible != cone_.end()) {
        assign(*visible, point);
      } else if (side(0, point) > 0) {
        assign(0, point);
      }
    }
  }

  // Breadth first, so that all parts of the hull become finer together.
  void grow() {
    while (!waiting_.empty()) {
      const std::uint32_t facet = waiting_.front();
      waiting_.pop_front();
      const std::uint32_t farthest = facets_[facet].outside;
      // They may be another facet's by now.
      if (farthest == kNone) continue;
      add_corner(farthest, facet);
      partition(farthest);
    }
  }

  std::vector<std::vector<std::uint32_t>> faces() {
    number_faces();
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<bool> is_seen(face_of_.size(), false);
    for (std::uint32_t facet = 0; facet < facets_.size(); ++facet) {
      if (facets_[facet].is_gone) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge{facet, k};
        if (is_seen[face_of_[facet]] || !is_rim(edge)) continue;
        is_seen[face_of_[facet]] = true;
        faces.push_back(corners_along(edge));
      }
    }
    return faces;
  }

 private:
  // +1 where the point is above the facet, and sees it; 0 in its plane.
  int side(std::uint32_t facet, std::uint32_t point) const {
    const Facet& f = facets_[facet];
    const double height = f.plane.height(points_[point]);
    if (std::abs(height) > f.plane.rounding()) return height > 0 ? 1 : -1;
    const auto& [a, b, c] = f.corners;
    return orientation(points_[a], points_[b], points_[c], points_[point]);
  }

  std::uint32_t make_facet(std::array<std::uint32_t, 3> corners) {
    Facet facet;
    facet.corners = corners;
    const auto& [a, b, c] = corners;
    facet.plane = OrientedPlane(points_[a], points_[b], points_[c], extent_);
    if (free_.empty()) {
      facets_.push_back(facet);
      return static_cast<std::uint32_t>(facets_.size() - 1);
    }
    const std::uint32_t id = free_.back();
    free_.pop_back();
    facets_[id] = facet;
    return id;
  }

  void assign(std::uint32_t facet, std::uint32_t point) {
    Facet& f = facets_[facet];
    const double height = f.plane.height(points_[point]);
    if (f.outside == kNone) waiting_.push_back(facet);
    if (f.outside == kNone || height > f.height) {
      next_[point] = f.outside;
      f.outside = point;
      f.height = height;
    } else {
      next_[point] = next_[f.outside];
      next_[f.outside] = point;
    }
  }

  // Replaces the facets that the point sees, of which `facet` is one. Their
  // outside sets are unassigned then.
  void add_corner(std::uint32_t point, std::uint32_t facet) {
    find_horizon(point, facet);
    unassigned_.clear();
    for (const std::uint32_t gone : visible_) {
      for (std::uint32_t p = facets_[gone].outside; p != kNone; p = next_[p]) {
        unassigned_.push_back(p);
      }
      facets_[gone].outside = kNone;
    }
    free_.insert(free_.end(), visible_.begin(), visible_.end());
    make_cone(point);
  }

  void find_horizon(std::uint32_t point, std::uint32_t facet) {
    visible_ = {facet};
    facets_[facet].is_gone = true;
    horizon_.clear();
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      const Facet& f = facets_[visible_[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t beyond = f.neighbours[k];
        if (facets_[beyond].is_gone) continue;
        if (side(beyond, point) > 0) {
          facets_[beyond].is_gone = true;
          visible_.push_back(beyond);
        } else {
          const std::uint32_t end = f.corners[(k + 1) % 3];
          horizon_.push_back({beyond, facets_[beyond].edge_from(end)});
        }
      }
    }
  }

  // Facets from the horizon to the apex, in order around it.
  void make_cone(std::uint32_t apex) {
    cone_.clear();
    for (const Edge& rim : horizon_) {
      const std::uint32_t to = facets_[rim.facet].corners[rim.index];
      const std::uint32_t from =
          facets_[rim.facet].corners[(rim.index + 1) % 3];
      const std::uint32_t facet = make_facet({from, to, apex});
      facets_[facet].neighbours[0] = rim.facet;
      facets_[rim.facet].neighbours[rim.index] = facet;
      cone_at_[from] = facet;
    }
    std::uint32_t facet =
        facets_[horizon_[0].facet].neighbours[horizon_[0].index];
    for (std::size_t i = 0; i < horizon_.size(); ++i) {
      cone_.push_back(facet);
      const std::uint32_t after = cone_at_[facets_[facet].corners[1]];
      facets_[facet].neighbours[1] = after;
      facets_[after].neighbours[2] = facet;
      facet = after;
    }
  }

  // Assigns the points to facets of the cone. One that sees none of these is
  // within the hull: it saw a facet that is gone, and what a point sees is of
  // one piece; so if it saw one that is left, it would see both sides of an
  // edge of the horizon, and with them the cone's facet there.
  void partition(std::uint32_t apex) {
    if (unassigned_.size() == 1) return;  // the apex
    // The last two facets shall not share a plane: see find_visible().
    auto last = cone_.begin() + 1;
    while (side(last[-1], facets_[last[0]].corners[1]) == 0) ++last;
    std::rotate(cone_.begin(), last + 1, cone_.end());
    for (const std::uint32_t point : unassigned_) {
      if (point == apex) continue;
      const std::uint32_t facet = find_visible(point, apex);
      if (facet != kNone) assign(facet, point);
    }
  }

  // A facet of the cone that the point sees. Planes through the apex, the
  // horizon's corner 0 and its other corners part the cone into wedges that
  // grow in order, and the wedge that holds the point decides. Wedges without
  // width lie in the plane of the first facet only, so the search takes the
  // last of those that hold the point.
  std::uint32_t find_visible(std::uint32_t point, std::uint32_t apex) const {
    if (side(cone_.front(), point) > 0) return cone_.front();
    if (side(cone_.back(), point) > 0) return cone_.back();
    const auto corner = [&](std::size_t i) {
      return points_[facets_[cone_[i]].corners[0]];
    };
    std::size_t low = 1;
    std::size_t high = cone_.size() - 1;
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      const int turn =
          orientation(points_[apex], corner(0), corner(middle), points_[point]);
      (turn <= 0 ? low : high) = middle;
    }
    return side(cone_[low], point) > 0 ? cone_[low] : kNone;
  }

  // --- Faces -----------------------------------------------------------------

  void number_faces() {
    face_of_.assign(facets_.size(), kNone);
    std::vector<std::uint32_t> open;
    for (std::uint32_t start = 0; start < facets_.size(); ++start) {
      if (facets_[start].is_gone || face_of_[start] != kNone) continue;
      face_of_[start] = start;
      open.push_back(start);
      while (!open.empty()) {
        const std::uint32_t facet = open.back();
        open.pop_back();
        for (std::size_t k = 0; k < 3; ++k) {
          const Edge beyond = twin({facet, k});
          if (face_of_[beyond.facet] != kNone) continue;
          const std::uint32_t opposite =
              facets_[beyond.facet].corners[(beyond.index + 2) % 3];
          if (side(facet, opposite) != 0) continue;
          face_of_[beyond.facet] = start;
          open.push_back(beyond.facet);
        }
      }
    }
  }

  Edge twin(Edge edge) const {
    const Facet& f = facets_[edge.facet];
    const std::uint32_t beyond = f.neighbours[edge.index];
    return {beyond, facets_[beyond].edge_from(f.corners[(edge.index + 1) % 3])};
  }

  std::uint32_t face_beyond(Edge edge) const {
    return face_of_[facets_[edge.facet].neighbours[edge.index]];
  }
  bool is_rim(Edge edge) const {
    return face_beyond(edge) != face_of_[edge.facet];
  }

  // Along the rim of a face.
  std::vector<std::uint32_t> corners_along(Edge start) const {
    std::vector<std::uint32_t> corners;
    Edge edge = start;
    do {
      const std::uint32_t beyond = face_beyond(edge);
      edge.index = (edge.index + 1) % 3;
      while (!is_rim(edge)) {
        edge = twin(edge);
        edge.index = (edge.index + 1) % 3;
      }
      // Where only two faces meet they do so along a straight line.
      if (face_beyond(edge) != beyond) {
        corners.push_back(facets_[edge.facet].corners[edge.index]);
      }
    } while (edge.facet != start.facet || edge.index != start.index);
    return corners;
  }

  std::span<const Vec3> points_;
  Vec3 extent_ = Vec3(0);
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> free_;     // facets that are gone
  std::deque<std::uint32_t> waiting_;   // facets that got outside sets
  std::vector<std::uint32_t> next_;     // of each point, on its list
  std::vector<std::uint32_t> face_of_;  // of each facet

  // What the last corner sees, and what takes its place.
  std::vector<std::uint32_t> visible_;
  std::vector<Edge> horizon_;
  std::vector<std::uint32_t> cone_;
  std::vector<std::uint32_t> cone_at_;  // by the point where its edge 0 begins
  std::vector<std::uint32_t> unassigned_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> hull_faces(
    std::span<const Vec3> points, std::array<std::uint32_t, 4> simplex) {
  const auto& [a, b, c, d] = simplex;
  const int sign = orientation(points[a], points[b], points[c], points[d]);
  if (sign == 0) return {};
  Quickhull hull(points);
  if (sign < 0) {
    hull.start(a, b, c, d);
  } else {
    hull.start(a, c, b, d);
  }
  hull.grow();
  return hull.faces();
}

}  // namespace lamina::csg
