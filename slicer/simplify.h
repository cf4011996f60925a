#pragma once
// Leaves out the vertices of a layer that do not matter.
//
// A section of a fine tessellation has a vertex every few micrometres; a wax
// printer's beam is ten times wider. Dropping vertices is easy; keeping walls
// and gaps thinner than the tolerance open is what needs thought, and sections
// of real jewelry have them.
//
// 1. Sleeve. From an anchor vertex a the run of vertices that follow is
//    extended as long as a straight line from a passes within the tolerance of
//    them all: a cone of admissible directions that narrows with every vertex,
//    O(1) each (Williams 1978; Imai and Iri 1988 for the bound).
// 2. Proof. In the frame of the shortcut a-b the run must lie in the
//    rectangle R = [0, length] × [lowest, highest deviation], the deviations
//    at most the tolerance. Then every point of the run is within the
//    tolerance of the shortcut, and, since the run crosses every abscissa of
//    it, the other way round.
// 3. Safety. No vertex of the layer that is not of the run may lie in R. This
//    one test keeps the topology of everything: an edge of another part that
//    meets the shortcut would enter and leave R (it has no end inside), part a
//    from b in R, and so cross the run; but contours are disjoint. The same
//    holds for two shortcuts, since the ends of each are foreign to the other.
//    So loops stay simple and disjoint, keep their nesting, and nothing small
//    changes sides. A run that fails is halved.
// 4. Loops as thin as the tolerance themselves are treated with a quarter of
//    their own thickness (2 · area / perimeter), so that none collapses: a loop
//    within d of a line is at most 2 d thick.
//
// For the foreign vertices all vertices stand in a grid of some four times as
// many cells, as lists of runs of neighbours: a shortcut walks the cells under
// R and skips its own run in one step. So the whole is linear in practice: 25
// to 30 ns a vertex on the sections of a ring of a million facets.

#include <cstdint>
#include <vector>

#include "ldni/contours.h"

namespace lamina::slicer {

// One object per thread: it owns the scratch that layers share.
class Simplifier {
 public:
  // tolerance  greatest distance between the old and the new contour [mm];
  //            0 leaves everything as it is
  explicit Simplifier(double tolerance) : tolerance_(tolerance) {}

  // Simple, disjoint loops stay so, in the same order and orientation; each
  // begins at its lowest of the leftmost points.
  void simplify(ldni::Contours& contours);

 private:
  // Vertices i in the same cell as i-1 continue its run.
  struct Cells {
    std::vector<std::uint32_t> last;  // cell → last vertex of its newest run
    double x0 = 0;
    double y0 = 0;
    double cells_per_mm = 0;
    std::uint32_t columns = 1;
    std::uint32_t rows = 1;
  };

  void fill_cells();
  void simplify_loop(std::uint32_t begin, std::uint32_t end);
  std::uint32_t longest_run(std::uint32_t anchor, std::uint32_t end,
                            double tolerance) const;
  bool is_safe(std::uint32_t anchor, std::uint32_t last, double tolerance);
  bool has_foreign_vertex(std::uint32_t anchor, std::uint32_t last, Vec2 along,
                          double length, double lowest, double highest) const;
  const Vec2& point(std::uint32_t i) const { return points_[i]; }

  double tolerance_;
  ldni::Contours result_;
  std::vector<Vec2> points_;  // of the layer, each loop closed by its first
  std::vector<std::uint32_t> loop_ends_;
  std::vector<std::uint32_t> run_begin_;     // vertex → first of its run
  std::vector<std::uint32_t> previous_run_;  // first of a run → last of the
                                             // run before it in that cell
  Cells cells_;
  bool has_cells_ = false;  // filled for the layer in hand
};

}  // namespace lamina::slicer
