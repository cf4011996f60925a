#include "tests/oracle/exact_region.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <boost/container/small_vector.hpp>
#include <fmt/format.h>

#include "tests/oracle/exact_edge.h"

namespace lamina::oracle {
namespace {

using Number = ExactKernel::FT;
using Point = ExactKernel::Point_2;
using Edge = ExactEdge;

// How often the winding number of a label grows on the way across a curve from
// its right to its left, the curve being directed from its lexicographically
// lesser end.
struct Crossing {
  std::uint32_t label;
  int growth;
};
using Crossings = boost::container::small_vector<Crossing, 2>;

// Curves that overlap are one curve with the crossings of both.
struct Join {
  Crossings operator()(const Crossings& a, const Crossings& b) const {
    Crossings all = a;
    for (const Crossing& crossing : b) {
      const auto same = std::find_if(
          all.begin(), all.end(),
          [&](const Crossing& c) { return c.label == crossing.label; });
      if (same == all.end()) {
        all.push_back(crossing);
      } else {
        same->growth += crossing.growth;
      }
    }
    return all;
  }
};

struct Cell {
  bool is_visited = false;
  unsigned kind = 0;
  std::size_t index = 0;
};

using SegmentTraits = CGAL::Arr_segment_traits_2<ExactKernel>;
using Traits = CGAL::Arr_curve_data_traits_2<SegmentTraits, Crossings, Join>;
using Arrangement =
    CGAL::Arrangement_2<Traits, CGAL::Arr_face_extended_dcel<Traits, Cell>>;
using Halfedge = Arrangement::Halfedge_handle;
using Face = Arrangement::Face_handle;

struct LabelledEdge {
  Point from;
  Point to;
  std::uint32_t label;
};

// What a cell with these winding numbers is.
using Classify = std::function<unsigned(std::span<const int>)>;

// All edges cut at their crossings, and every cell classified.
class Overlay {
 public:
  Overlay(std::span<const LabelledEdge> edges, std::size_t label_count,
          const Classify& classify) {
    std::vector<Traits::X_monotone_curve_2> curves;
    curves.reserve(edges.size());
    for (const LabelledEdge& edge : edges) {
      const auto order = CGAL::compare_xy(edge.from, edge.to);
      if (order == CGAL::EQUAL) continue;
      const int growth = order == CGAL::SMALLER ? 1 : -1;
      curves.emplace_back(SegmentTraits::X_monotone_curve_2(edge.from, edge.to),
                          Crossings{{edge.label, growth}});
    }
    CGAL::insert(arrangement_, curves.begin(), curves.end());
    classify_cells(label_count, classify);
  }

  Arrangement& arrangement() { return arrangement_; }
  std::size_t cell_count() const { return cell_count_; }

 private:
  // Walks from cell to cell, out and back, with one set of winding numbers.
  void classify_cells(std::size_t label_count, const Classify& classify) {
    std::vector<int> winding(label_count, 0);
    struct Step {
      std::vector<Halfedge> ways;  // halfedges of the cell yet to be crossed
      Halfedge entry;              // of this cell; its twin leads back
    };
    std::vector<Step> path;
    const auto enter = [&](Face face, Halfedge entry) {
      face->data() = {true, classify(winding), cell_count_++};
      path.push_back({halfedges_of(face), entry});
    };
    enter(arrangement_.unbounded_face(), Halfedge());
    while (!path.empty()) {
      Step& step = path.back();
      if (step.ways.empty()) {
        if (path.size() > 1) cross(step.entry->twin(), winding);
        path.pop_back();
        continue;
      }
      const Halfedge way = step.ways.back()->twin();
      step.ways.pop_back();
      if (way->face()->data().is_visited) continue;
      cross(way, winding);
      enter(way->face(), way);
    }
  }

  static std::vector<Halfedge> halfedges_of(Face face) {
    std::vector<Halfedge> all;
    const auto add_round = [&](Arrangement::Ccb_halfedge_circulator begin) {
      auto current = begin;
      do all.push_back(current);
      while (++current != begin);
    };
    for (auto it = face->outer_ccbs_begin(); it != face->outer_ccbs_end();
         ++it) {
      add_round(*it);
    }
    for (auto it = face->inner_ccbs_begin(); it != face->inner_ccbs_end();
         ++it) {
      add_round(*it);
    }
    return all;
  }

  // Winding numbers after stepping onto the left of `halfedge` from its right.
  static void cross(Halfedge halfedge, std::vector<int>& winding) {
    const int sign = halfedge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? 1 : -1;
    for (const Crossing& crossing : halfedge->curve().data()) {
      winding[crossing.label] += sign * crossing.growth;
    }
  }

  Arrangement arrangement_;
  std::size_t cell_count_ = 0;
};

Vec2 rounded(const Point& point) {
  return {CGAL::to_double(point.x()), CGAL::to_double(point.y())};
}

// Area of the cell on the left of a chain of halfedges, relative to a point of
// it so that no digits are lost.
double ccb_area(Arrangement::Ccb_halfedge_circulator begin) {
  const Vec2 origin = rounded(begin->source()->point());
  double doubled = 0;
  auto current = begin;
  do {
    const Vec2 a = rounded(current->source()->point()) - origin;
    const Vec2 b = rounded(current->target()->point()) - origin;
    doubled += a.x * b.y - a.y * b.x;
  } while (++current != begin);
  return doubled / 2;
}

double cell_area(Face face) {
  double area = 0;
  for (auto it = face->outer_ccbs_begin(); it != face->outer_ccbs_end(); ++it) {
    area += ccb_area(*it);
  }
  for (auto it = face->inner_ccbs_begin(); it != face->inner_ccbs_end(); ++it) {
    area += ccb_area(*it);
  }
  return area;
}

// Components of the cells inside and outside by one bit of their kind.
RegionCounts count_components(Overlay& overlay, unsigned bit) {
  std::vector<std::size_t> parent(overlay.cell_count());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  Arrangement& arrangement = overlay.arrangement();
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    const Cell& left = e->face()->data();
    const Cell& right = e->twin()->face()->data();
    if ((left.kind & bit) == (right.kind & bit)) {
      parent[find(left.index)] = find(right.index);
    }
  }
  RegionCounts counts;
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    const Cell& cell = f->data();
    if (find(cell.index) != cell.index) continue;
    ++((cell.kind & bit) != 0 ? counts.regions : counts.holes);
  }
  --counts.holes;  // the unbounded component
  return counts;
}

// Directed edges around the cells of odd kind.
std::vector<Edge> boundary_of(Overlay& overlay) {
  std::vector<Edge> edges;
  Arrangement& arrangement = overlay.arrangement();
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    const bool left = (e->face()->data().kind & 1) != 0;
    const bool right = (e->twin()->face()->data().kind & 1) != 0;
    if (left == right) continue;
    const Point& source = e->source()->point();
    const Point& target = e->target()->point();
    // Later constructions need not remember how these points came about.
    CGAL::exact(source);
    CGAL::exact(target);
    edges.push_back(left ? Edge{source, target} : Edge{target, source});
  }
  return edges;
}

// Where the plane cuts the edge from a to b: the same for b to a.
Point cut_edge(const Vec3& a, const Vec3& b, double z) {
  const Number share = (Number(z) - a.z) / (Number(b.z) - a.z);
  return {a.x + (Number(b.x) - a.x) * share, a.y + (Number(b.y) - a.y) * share};
}

// The section of an indexed mesh. A point is made once for each edge of the
// mesh, so whether the section is closed is a matter of indices.
class MeshCutter {
 public:
  MeshCutter(const csg::Mesh& mesh, double z) : mesh_(mesh), z_(z) {
    for (const auto& triangle : mesh.triangles) cut(triangle);
  }

  // Adds edges that lead from open ends to the nearest open beginnings.
  void join_open_ends(double gap) {
    std::vector<Point> ends;
    std::vector<Point> beginnings;
    for (const auto& [key, cut] : cuts_) {
      auto& list = cut.surplus > 0 ? ends : beginnings;
      list.insert(list.end(), static_cast<std::size_t>(std::abs(cut.surplus)),
                  cut.point);
    }
    for (const Point& end : ends) join(end, beginnings, gap);
  }

  const std::vector<Edge>& edges() const { return edges_; }

 private:
  struct Cut {
    Point point;
    int surplus = 0;  // edges that end here less those that begin here
  };

  // The section enters a triangle, the inner side on its left, where the
  // border leads down: seen from outside, the border runs counter-clockwise.
  void cut(const std::array<std::uint32_t, 3>& triangle) {
    Cut* enter = nullptr;
    Cut* leave = nullptr;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      const bool is_a_above = mesh_.vertices[a].z > z_;
      if (is_a_above == (mesh_.vertices[b].z > z_)) continue;
      (is_a_above ? enter : leave) = &cut_at(std::min(a, b), std::max(a, b));
    }
    if (enter == nullptr) return;
    --enter->surplus;
    ++leave->surplus;
    edges_.push_back({enter->point, leave->point});
  }

  Cut& cut_at(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t{a} << 32) | b;
    const auto [it, is_new] = cuts_.try_emplace(key);
    if (is_new) {
      it->second.point = cut_edge(mesh_.vertices[a], mesh_.vertices[b], z_);
    }
    return it->second;
  }

  void join(const Point& end, std::vector<Point>& beginnings, double gap) {
    const Vec2 place = rounded(end);
    auto nearest = beginnings.end();
    double least = INFINITY;
    for (auto it = beginnings.begin(); it != beginnings.end(); ++it) {
      const Vec2 step = rounded(*it) - place;
      const double distance = std::hypot(step.x, step.y);
      if (distance < least) {
        least = distance;
        nearest = it;
      }
    }
    if (!(least <= gap)) {
      throw std::runtime_error(
          fmt::format("the section at z = {} is open by {} mm at ({}, {})", z_,
                      least, place.x, place.y));
    }
    edges_.push_back({end, *nearest});
    beginnings.erase(nearest);
  }

  const csg::Mesh& mesh_;
  double z_;
  std::unordered_map<std::uint64_t, Cut> cuts_;
  std::vector<Edge> edges_;
};

void append(std::vector<LabelledEdge>& all, std::span<const Edge> edges,
            std::uint32_t label) {
  for (const Edge& edge : edges) all.push_back({edge.from, edge.to, label});
}

std::vector<Edge> edges_of_loops(const plane::Contours& contours) {
  std::vector<Edge> edges;
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    const auto loop = contours.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2& from = loop[i];
      const Vec2& to = loop[(i + 1) % loop.size()];
      edges.push_back({Point(from.x, from.y), Point(to.x, to.y)});
    }
  }
  return edges;
}

ExactRegion make_region(std::vector<Edge> edges) {
  return ExactRegion(std::make_shared<const ExactRegion::Edges>(
      ExactRegion::Edges{std::move(edges)}));
}

// Where edges of one label wind at least once.
ExactRegion region_of_edges(std::span<const Edge> edges) {
  std::vector<LabelledEdge> all;
  append(all, edges, 0);
  Overlay overlay(all, 1, [](std::span<const int> winding) {
    return winding[0] > 0 ? 1U : 0U;
  });
  return make_region(boundary_of(overlay));
}

// Counter-clockwise around everything nearer to the edge than `distance`, in
// the norm of the greatest coordinate.
std::vector<Edge> band_around(Vec2 from, Vec2 to, double distance) {
  const double x_sign = to.x >= from.x ? 1 : -1;
  const double y_sign = to.y >= from.y ? 1 : -1;
  const double x = x_sign * distance;
  const double y = y_sign * distance;
  std::vector<Point> corners = {
      {from.x - x, from.y + y}, {from.x - x, from.y - y},
      {from.x + x, from.y - y}, {to.x + x, to.y - y},
      {to.x + x, to.y + y},     {to.x - x, to.y + y}};
  if (x_sign * y_sign < 0) std::reverse(corners.begin(), corners.end());
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return edges;
}

enum class Shift { kOutward, kInward };

// The region grown or shrunk by `distance`. Its points are rounded first, so
// that the numbers do not grow from step to step; the rounding is far below
// any distance asked for.
ExactRegion shifted(const ExactRegion& region, double distance, Shift shift) {
  std::vector<LabelledEdge> all;
  for (const Edge& edge : region.edges().all) {
    const Vec2 from = rounded(edge.from);
    const Vec2 to = rounded(edge.to);
    all.push_back({Point(from.x, from.y), Point(to.x, to.y), 0});
    append(all, band_around(from, to, distance), 1);
  }
  const bool grows = shift == Shift::kOutward;
  Overlay overlay(all, 2, [grows](std::span<const int> winding) {
    const bool is_band = winding[1] > 0;
    const bool is_inside = winding[0] > 0;
    return (grows ? is_inside || is_band : is_inside && !is_band) ? 1U : 0U;
  });
  return make_region(boundary_of(overlay));
}

double total_length(std::span<const Edge> edges) {
  double length = 0;
  for (const Edge& edge : edges) {
    const Vec2 step = rounded(edge.to) - rounded(edge.from);
    length += std::hypot(step.x, step.y);
  }
  return length;
}

constexpr unsigned kExpected = 1;
constexpr unsigned kActual = 2;
constexpr unsigned kOverlapping = 4;

Comparison compare_edges(const ExactRegion& expected,
                         std::span<const Edge> actual) {
  std::vector<LabelledEdge> all;
  append(all, expected.edges().all, 0);
  append(all, actual, 1);
  Overlay overlay(all, 2, [](std::span<const int> winding) {
    return (winding[0] > 0 ? kExpected : 0U) | (winding[1] > 0 ? kActual : 0U) |
           (winding[1] < 0 || winding[1] > 1 ? kOverlapping : 0U);
  });

  Comparison result;
  result.expected_counts = count_components(overlay, kExpected);
  result.actual_counts = count_components(overlay, kActual);
  result.expected_perimeter = total_length(expected.edges().all);
  result.actual_perimeter = total_length(actual);
  Arrangement& arrangement = overlay.arrangement();
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    const unsigned kind = f->data().kind;
    if (kind == 0 || f->is_unbounded()) continue;
    const double area = std::abs(cell_area(f));
    if ((kind & kExpected) != 0) result.expected_area += area;
    if ((kind & kActual) != 0) result.actual_area += area;
    if ((kind & kOverlapping) != 0) result.overlap_area += area;
    if (((kind & kExpected) != 0) == ((kind & kActual) != 0)) continue;
    result.difference_area += area;
    if (area > result.worst_area) {
      result.worst_area = area;
      result.worst_place = rounded((*f->outer_ccbs_begin())->source()->point());
    }
  }
  return result;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const RegionCounts& counts) {
  return out << counts.regions << " regions, " << counts.holes << " holes";
}

ExactRegion::ExactRegion() : edges_(std::make_shared<const Edges>()) {}
ExactRegion::ExactRegion(std::shared_ptr<const Edges> edges)
    : edges_(std::move(edges)) {}

std::size_t ExactRegion::edge_count() const { return edges_->all.size(); }

ExactRegion exact_section(const WorldScene& scene, double z) {
  std::vector<LabelledEdge> all;
  for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
    MeshCutter cutter(scene.meshes[i], z);
    cutter.join_open_ends(0);
    append(all, cutter.edges(), i);
  }
  Overlay overlay(all, scene.meshes.size(), [&](std::span<const int> winding) {
    return evaluate_program(scene, winding) ? 1U : 0U;
  });
  return make_region(boundary_of(overlay));
}

ExactRegion exact_section(const csg::Mesh& mesh, double z, double gap) {
  MeshCutter cutter(mesh, z);
  cutter.join_open_ends(gap);
  return region_of_edges(cutter.edges());
}

double overlap_of_section(const csg::Mesh& mesh, double z, double gap) {
  MeshCutter cutter(mesh, z);
  cutter.join_open_ends(gap);
  return compare_edges(ExactRegion(), cutter.edges()).overlap_area;
}

ExactRegion region_of_loops(const plane::Contours& contours) {
  return region_of_edges(edges_of_loops(contours));
}

RegionCounts count_regions(const ExactRegion& region) {
  return compare_edges(region, {}).expected_counts;
}

std::string exact_area(const ExactRegion& region) {
  Number doubled = 0;
  for (const Edge& edge : region.edges().all) {
    doubled += edge.from.x() * edge.to.y() - edge.from.y() * edge.to.x();
  }
  std::ostringstream text;
  text << CGAL::exact(doubled / 2);
  return text.str();
}

ExactRegion settle(const ExactRegion& region, double distance) {
  ExactRegion settled = shifted(region, distance, Shift::kOutward);
  settled = shifted(settled, 4 * distance, Shift::kInward);
  return shifted(settled, 2 * distance, Shift::kOutward);
}

Comparison compare(const ExactRegion& expected, const plane::Contours& actual) {
  return compare_edges(expected, edges_of_loops(actual));
}

Comparison compare(const ExactRegion& expected, const ExactRegion& actual) {
  return compare_edges(expected, actual.edges().all);
}

}  // namespace lamina::oracle
