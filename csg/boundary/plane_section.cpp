#include "csg/boundary/plane_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "plane/predicates.h"
#include "plane/tie_distance.h"

namespace lamina::csg {
namespace {

using plane::Contour;
using Side = WindowSection::Side;
using EdgeKey = std::uint64_t;

// What a face of a closed surface leaves in the plane, the inside on its left.
struct Segment {
  EdgeKey begin_edge;
  EdgeKey end_edge;
  Vec2 begin;
  Vec2 end;
};

CutTriangle measure(const LeafFaces& faces, const Plane& plane,
                    const LeafFaces::Triangle& corners) {
  CutTriangle triangle{corners, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = plane.height(faces.vertices[corners[k]]);
    triangle.heights[k] = std::abs(h) <= kTieDistance ? 0 : h;
  }
  return triangle;
}

// The segments of triangles in one plane, on one side.
class Cutter {
 public:
  Cutter(const LeafFaces& faces, const Plane& plane, Side side)
      : faces_(faces), plane_(plane), side_(side) {}

  void cut(const CutTriangle& triangle, std::vector<Segment>& segments) const {
    const auto& [t, heights] = triangle;
    // Counter-clockwise from outside, the segment begins on the edge that goes
    // down.
    Segment segment{};
    bool is_cut = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (is_above(heights[i]) == is_above(heights[j])) continue;
      is_cut = true;
      const std::uint64_t low = std::min(t[i], t[j]);
      const EdgeKey key = low << 32 | std::max(t[i], t[j]);
      const Vec2 point = t[i] < t[j]
                             ? cross(t[i], heights[i], t[j], heights[j])
                             : cross(t[j], heights[j], t[i], heights[i]);
      if (is_above(heights[i])) {
        segment.begin_edge = key;
        segment.begin = point;
      } else {
        segment.end_edge = key;
        segment.end = point;
      }
    }
    if (is_cut) segments.push_back(segment);
  }

 private:
  bool is_above(double h) const {
    return side_ == Side::kAbove ? h > 0 : h >= 0;
  }

  Vec2 cross(std::uint32_t a, double height_a, std::uint32_t b,
             double height_b) const {
    const Vec2 from = plane_.flatten(faces_.vertices[a]);
    const Vec2 to = plane_.flatten(faces_.vertices[b]);
    if (height_b == 0) return to;
    return from + (to - from) * (height_a / (height_a - height_b));
  }

  const LeafFaces& faces_;
  const Plane& plane_;
  const Side side_;
};

// Segments joined where they share an edge.
struct Chains {
  std::vector<Contour> closed;
  std::vector<Contour> open;
};

class Chainer {
 public:
  explicit Chainer(std::span<const Segment> segments) : segments_(segments) {
    std::unordered_map<EdgeKey, int> balance;
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      starts_.emplace(segments[i].begin_edge, i);
      ++balance[segments[i].begin_edge];
      --balance[segments[i].end_edge];
    }
    // Open ones first: a loop that is begun anywhere comes back.
    for (const Segment& segment : segments) {
      if (balance[segment.begin_edge] > 0) {
        --balance[segment.begin_edge];
        follow(segment.begin_edge);
      }
    }
    while (!starts_.empty()) follow(starts_.begin()->first);
  }

  Chains take() { return std::move(chains_); }

 private:
  void follow(const EdgeKey first) {
    Contour points;
    EdgeKey edge = first;
    const Segment* last = nullptr;
    for (auto next = starts_.find(edge); next != starts_.end();
         next = starts_.find(edge)) {
      last = &segments_[next->second];
      starts_.erase(next);
      points.push_back(last->begin);
      edge = last->end_edge;
      if (edge == first) break;
    }
    if (edge == first) {
      chains_.closed.push_back(std::move(points));
    } else {
      points.push_back(last->end);
      chains_.open.push_back(std::move(points));
    }
  }

  std::span<const Segment> segments_;
  std::unordered_multimap<EdgeKey, std::uint32_t> starts_;
  Chains chains_;
};

// Closes chains whose ends lie outside of the window by ways that do not enter
// it: straight out to a frame around everything, and along the frame.
class Frame {
 public:
  Frame(const Box2& window, const Chains& chains)
      : window_(window), frame_(window) {
    for (const Contour& chain : chains.open) frame_.add(chain);
    const Vec2 margin = frame_.size() + kTieDistance;
    frame_.low -= margin;
    frame_.high += margin;
  }

  void close(Contour& chain) const {
    const double end = exit_of(chain.front());
    const double begin = exit_of(chain.back());
    chain.push_back(point_at(begin));
    const double stop = end < begin ? end + 4 : end;
    for (int corner = static_cast<int>(begin) + 1; corner < stop; ++corner) {
      chain.push_back(point_at(corner));
    }
    chain.push_back(point_at(end));
  }

  Contour contour() const {
    return {point_at(0), point_at(1), point_at(2), point_at(3)};
  }

 private:
  // Places on the frame are numbers from 0 to 4, counter-clockwise: side, and
  // share of the side. A point leaves by the side of the window it is beyond.
  double exit_of(Vec2 p) const {
    const std::array<double, 4> beyond{
        window_.low.y - p.y, p.x - window_.high.x, p.y - window_.high.y,
        window_.low.x - p.x};
    const auto side =
        std::max_element(beyond.begin(), beyond.end()) - beyond.begin();
    const Vec2 share = (p - frame_.low) / frame_.size();
    switch (side) {
      case 0:
        return share.x;
      case 1:
        return 1 + share.y;
      case 2:
        return 3 - share.x;
      default:
        return 4 - share.y;
    }
  }

  Vec2 point_at(double place) const {
    const double side = std::floor(std::fmod(place, 4));
    const double share = std::fmod(place, 1);
    const auto& [low, high] = frame_;
    const Vec2 size = frame_.size();
    if (side == 0) return {low.x + share * size.x, low.y};
    if (side == 1) return {high.x, low.y + share * size.y};
    if (side == 2) return {high.x - share * size.x, high.y};
    return {low.x, high.y - share * size.y};
  }

  Box2 window_;
  Box2 frame_;
};

std::vector<Box3> boxes_of(const LeafFaces& faces) {
  std::vector<Box3> boxes;
  for (std::size_t i = 0; i < faces.faces.size(); ++i) {
    boxes.push_back(faces.box_of(i));
  }
  return boxes;
}

std::vector<Box3> boxes_of_triangles(const LeafFaces& faces, std::size_t face) {
  std::vector<Box3> boxes;
  for (const LeafFaces::Triangle& t : faces.triangles_of(face)) {
    Box3& box = boxes.emplace_back();
    for (const std::uint32_t corner : t) box.add(faces.vertices[corner]);
  }
  return boxes;
}

// Returns the winding number of the section at a point of the plane, along the
// ray +u.
int section_winding(const PlacedLeaf& leaf, const Plane& plane, Side side,
                    Vec2 c) {
  const Cutter cutter(leaf.faces, plane, side);
  std::vector<Segment> segments;
  const auto may_cross = [&](const Box3& box) {
    const Vec2 low = plane.flatten(box.low) - kTieDistance;
    const Vec2 high = plane.flatten(box.high) + kTieDistance;
    return low.y <= c.y && c.y <= high.y && c.x <= high.x && plane.meets(box);
  };
  leaf.visit_triangles(may_cross, [&](const LeafFaces::Triangle& t) {
    cutter.cut(measure(leaf.faces, plane, t), segments);
  });
  int sum = 0;
  for (const Segment& segment : segments) {
    sum += crossing(segment.begin, segment.end, c);
  }
  return sum;
}

// Whether the line between the points passes the window by less than the
// rounding of the points.
bool is_near(const Box2& window, Vec2 from, Vec2 to) {
  const Vec2 middle = 0.5 * (window.low + window.high);
  const Vec2 reach = 0.5 * window.size() + kTieDistance;
  const Vec2 low = glm::min(from, to) - middle;
  const Vec2 high = glm::max(from, to) - middle;
  if (low.x > reach.x || low.y > reach.y || high.x < -reach.x ||
      high.y < -reach.y) {
    return false;
  }
  const Vec2 along = to - from;
  const Vec2 across(-along.y, along.x);
  return std::abs(glm::dot(across, middle - from)) <=
         glm::dot(glm::abs(across), reach);
}

}  // namespace

Plane::Plane(Vec3 point, Vec3 normal) : point_(point), normal_(normal) {
  const Vec3 size = glm::abs(normal);
  dropped_ = size.y > size.x ? 1 : 0;
  if (size.z > size[dropped_]) dropped_ = 2;
  u_ = (dropped_ + 1) % 3;
  v_ = (dropped_ + 2) % 3;
  if (normal[dropped_] < 0) std::swap(u_, v_);
}

double Plane::height(Vec3 p) const { return glm::dot(normal_, p - point_); }

Vec3 Plane::lift(Vec2 p) const {
  Vec3 result;
  result[u_] = p.x;
  result[v_] = p.y;
  result[dropped_] = point_[dropped_] - (normal_[u_] * (p.x - point_[u_]) +
                                         normal_[v_] * (p.y - point_[v_])) /
                                            normal_[dropped_];
  return result;
}

bool Plane::meets(const Box3& box) const {
  const double reach = glm::dot(glm::abs(normal_), 0.5 * (box.high - box.low));
  return std::abs(height(0.5 * (box.low + box.high))) <=
         reach + 2 * kTieDistance;
}

PlacedLeaf::PlacedLeaf(const Leaf& leaf, const Affine& world_from_leaf)
    : faces(faces_of(leaf, world_from_leaf)), tree(boxes_of(faces)) {
  // So few are cut one by one.
  constexpr std::size_t kFewTriangles = 16;
  for (std::uint32_t face = 0; face < faces.faces.size(); ++face) {
    if (faces.triangles_of(face).size() <= kFewTriangles) continue;
    triangle_trees.emplace(face, BoxTree(boxes_of_triangles(faces, face)));
  }
}

bool contains(const PlacedLeaf& leaf, Vec3 point) {
  // Along +x. A face that the ray's line meets lies on one side of the point:
  // else the point would lie in its box.
  const Vec2 c(point.y, point.z);
  int sum = 0;
  const auto is_met = [&](const Box3& box) {
    return box.high.x >= point.x && box.low.y <= c.x && c.x <= box.high.y &&
           box.low.z <= c.y && c.y <= box.high.z;
  };
  leaf.visit_triangles(is_met, [&](const LeafFaces::Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 from = leaf.faces.vertices[t[i]];
      const Vec3 to = leaf.faces.vertices[t[(i + 1) % 3]];
      sum += crossing({from.y, from.z}, {to.y, to.z}, c);
    }
  });
  return sum != 0;
}

Box3 box_of(const Plane& plane, const Box2& window) {
  Box3 box;
  for (const double u : {window.low.x, window.high.x}) {
    for (const double v : {window.low.y, window.high.y}) {
      const Vec3 corner = plane.lift({u, v});
      box.add(corner - 2 * kTieDistance);
      box.add(corner + 2 * kTieDistance);
    }
  }
  return box;
}

WindowSection::WindowSection(const PlacedLeaf& leaf, const Plane& plane,
                             const Box2& window)
    : leaf_(leaf), plane_(plane), window_(window) {
  const Box3 box = box_of(plane, window);
  const auto is_met = [&](const Box3& other) {
    return do_meet(box, other) && plane.meets(other);
  };
  leaf.tree.visit(is_met, [&](std::uint32_t face) {
    faces_.push_back(face);
    leaf.visit_triangles(face, is_met, [&](const LeafFaces::Triangle& t) {
      triangles_.push_back(measure(leaf.faces, plane, t));
    });
  });
  is_touched_ = std::any_of(
      triangles_.begin(), triangles_.end(), [](const CutTriangle& t) {
        return std::find(t.heights.begin(), t.heights.end(), 0) !=
               t.heights.end();
      });
}

std::optional<bool> WindowSection::uniform_value(Side side) const {
  if (!edges(side).empty()) return {};
  return corner_winding(side) != 0;
}

std::vector<WindowSection::Edge> WindowSection::edges(Side side) const {
  const Cutter cutter(leaf_.faces, plane_, side);
  std::vector<Segment> segments;
  for (const CutTriangle& t : triangles_) cutter.cut(t, segments);
  std::vector<Edge> edges;
  for (const Segment& segment : segments) {
    if (!is_near(window_, segment.begin, segment.end)) continue;
    edges.push_back({segment.begin, segment.end});
  }
  return edges;
}

int WindowSection::corner_winding(Side side) const {
  return section_winding(leaf_, plane_, side, window_.low);
}

plane::Region WindowSection::contours(Side side) const {
  const Cutter cutter(leaf_.faces, plane_, side);
  std::vector<Segment> segments;
  for (const CutTriangle& t : triangles_) cutter.cut(t, segments);
  Chains chains = Chainer(segments).take();
  const Frame frame(window_, chains);
  plane::Region result;
  for (Contour& chain : chains.closed) {
    result.contours.push_back(std::move(chain));
  }
  for (Contour& chain : chains.open) {
    frame.close(chain);
    result.contours.push_back(std::move(chain));
  }

  // These contours are right but for a constant, which the whole section has.
  int missing = corner_winding(side);
  for (const Contour& contour : result.contours) {
    missing -= winding_number(contour, window_.low);
  }
  Contour all = frame.contour();
  if (missing < 0) std::reverse(all.begin(), all.end());
  for (int i = 0; i < std::abs(missing); ++i) result.contours.push_back(all);
  return result;
}

plane::Region whole_section(const PlacedLeaf& leaf, const Plane& plane,
                            Side side) {
  const Cutter cutter(leaf.faces, plane, side);
  std::vector<Segment> segments;
  leaf.tree.visit([&](const Box3& box) { return plane.meets(box); },
                  [&](std::uint32_t face) {
                    for (const auto& t : leaf.faces.triangles_of(face)) {
                      cutter.cut(measure(leaf.faces, plane, t), segments);
                    }
                  });
  return {Chainer(segments).take().closed};
}

}  // namespace lamina::csg
