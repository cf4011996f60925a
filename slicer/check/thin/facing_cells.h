#pragma once
// Which edges of a layer may face each other across less than a given width.
//
// Thin places are rare, and most of a layer should cost no more than a look. A
// disk thinner than the width touches edges within half the width of its
// centre, so every edge is listed in all cells of a grid that come as near to
// it. A cell also has the directions of its edges, and of the turns between
// them, as 64 bits. Where no two of them are nearly opposite, no edges of the
// cell face each other: it is passed over and lists none. On a smooth part that
// is nearly every cell.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/cell_grid.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {

// Two sides face each other where they run in opposite directions but for this
// angle at most [rad]: 30 degrees. Then the disk between them touches them at
// places at least 150 degrees apart. That takes in every prong, and every taper
// that holds its width for about twice that width; it keeps out the corners of
// a part and the crevices where its leaves meet.
inline constexpr double kFacingAngle = 0.5235987755982988;

class FacingCells {
 public:
  // Replaces all edges by these, which must outlive the queries.
  void build(std::span<const LayerEdge> edges, double width);

  // Whether any two edges may face each other.
  bool has_facing() const { return has_facing_; }

  // Replaces `neighbours` by all edges near disks that may touch the edge and
  // one that faces it: in no order, each once, the edge among them. There are
  // none where nothing can face it.
  void gather(std::uint32_t edge, std::vector<std::uint32_t>& neighbours);

  // All edges, and perhaps more, that touch a disk thinner than the width
  // around that centre, if it touches two that face each other.
  std::span<const std::uint32_t> near(Vec2 centre) const {
    return members_[grid_.cell_of(centre)];
  }

 private:
  void choose_cells();
  void mark_directions();
  void list_members();
  // Calls visit(cell) for every cell within half the width of the edge, and
  // perhaps a few beside them.
  template <typename Visit>
  void visit_cells(const LayerEdge& edge, const Visit& visit) const;

  std::span<const LayerEdge> edges_;
  double margin_ = 0;
  CellGrid grid_;
  bool has_facing_ = false;
  std::vector<std::uint64_t> edge_directions_;
  std::vector<std::uint64_t> directions_;   // of a cell; 0: passed over
  CellLists<std::uint32_t> members_;        // edges, of cells not passed over
  std::vector<std::uint32_t> last_gather_;  // that each edge was in
  std::uint32_t gather_ = 0;
};

}  // namespace lamina::slicer
