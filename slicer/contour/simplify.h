#pragma once
// Leaves out the vertices of a layer that do not matter.
//
// A section of a fine tessellation has a vertex every few micrometres; a wax
// printer's beam is ten times wider. Dropping vertices is easy; to keep walls
// and gaps open that are thinner than the tolerance is not. The vertices that
// stay are the loops' own, so corners keep their digits.
//
// 1. Choose. From an anchor a the next vertex to keep is the farthest that a
//    straight line reaches within the tolerance of all between: a cone of
//    directions that narrows with every vertex (Imai and Iri 1988), O(1) each.
//    On sections of rings 1 to 3 % more vertices stay than the fewest possible.
// 2. Prove. In the frame of the shortcut a-b the run that it replaces must lie
//    in [0, length] × [-tolerance, tolerance], as it does by the choice: so
//    each of the two is within the tolerance of the other. Moving the run
//    straight down to the shortcut sweeps the strip between them; no vertex
//    that stays may lie in a strip. A tree of boxes separates nearly all strips
//    at once (edge_tree.h); the others are looked at one by one.
// 3. Repair. A run that fails is split at its farthest vertex until none does;
//    where that goes on for many rounds, all vertices stay for now.
// 4. Thin out. A vertex is left out where the runs before and behind it pass
//    the proof as one: a split, or a choice within less than the tolerance,
//    kept it.
//
// Why the topology stays. Prick the plane at all vertices that stay. Disjoint
// runs are moved to their shortcuts without crossing a prick. Two straight
// segments that cross, cross once, and no motion that respects the pricks could
// part them; so shortcuts do not cross, and loops stay simple, disjoint and
// nested as they were. (Loops may go on to touch in a vertex; a shortcut from
// one such vertex to another is not taken.) Vertices that do not stay need not
// be heeded: two walls closer than the tolerance are thinned out together.
//
// Loops keep at least half of their area and at most double it, lest those as
// small as the tolerance dwindle to slivers. The cost is linear in practice.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "plane/contours.h"
#include "plane/edge_tree.h"
#include "plane/point_grid.h"

namespace lamina::slicer {

// One object per thread: it owns the scratch that layers share.
class Simplifier {
 public:
  // tolerance  greatest distance between the old and the new contour [mm];
  //            0 leaves everything as it is
  explicit Simplifier(double tolerance) : tolerance_(tolerance) {}

  // Simple, disjoint loops stay so, in the same order and orientation; each
  // begins at its lowest of the leftmost points.
  void simplify(plane::Contours& contours);

  // Vertices that simplify() left keep this far from foreign edges, in x or in
  // y [mm]: more than rounding to 32-bit numbers can move them towards each
  // other. 0: not known.
  double clearance() const { return is_apart_ ? clearance_ : 0; }

 private:
  // Vertices [begin, end] of points_; the last is a copy of the first.
  struct Loop {
    std::uint32_t begin;
    std::uint32_t end;
    double doubled_area;     // signed [mm²]
    bool has_spare = false;  // vertices that the choice did not want
  };
  struct Shortcut;

  void copy_loops(const plane::Contours& contours);
  void choose(Loop& loop);
  void keep_all();
  void list_kept();
  void find_neighbours();
  bool has_meetings() const;
  bool repair();
  bool split_run(std::uint32_t k);
  void thin_out(const Loop& loop, std::uint32_t k, std::uint32_t end);
  void write_kept(plane::Contours& contours) const;

  double doubled_area_kept(std::size_t begin, std::size_t end) const;
  Shortcut measure(std::uint32_t first, std::uint32_t last) const;
  bool is_close(const Shortcut& shortcut) const;
  bool is_clear(const Shortcut& shortcut, std::uint32_t k,
                std::uint32_t last_k) const;
  bool is_in_strip(const Shortcut& shortcut, Vec2 place) const;

  double tolerance_;
  double clearance_ = 0;   // kept between shortcuts and other vertices [mm]
  bool is_apart_ = false;  // by the clearance
  std::vector<Vec2> points_;
  std::vector<Loop> loops_;
  std::vector<std::uint8_t> kept_;      // of points_
  std::vector<std::uint32_t> pending_;  // of a run, the ends that split it
  // The points that are kept, as the tree takes them.
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> ends_;
  plane::EdgeTree tree_;
  bool is_crowded_ = false;  // too many for the tree: the grid serves instead
  PointGrid grid_;
  // Bundles near bundle i: near_bundles_ from near_begins_[i] to
  // near_begins_[i + 1].
  std::vector<std::uint32_t> near_begins_;
  std::vector<std::uint32_t> near_bundles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> near_pairs_;
};

}  // namespace lamina::slicer
