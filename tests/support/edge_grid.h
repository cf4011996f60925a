#pragma once
// Sorts the edges of a layer into the cells of a uniform grid, for questions
// that only near edges can answer.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::support {

struct Edge {
  Vec2 from;
  Vec2 to;
  std::uint32_t loop = 0;
  std::uint32_t next = 0;  // index of the edge that follows in the loop
};

// All edges of all loops, loop by loop.
std::vector<Edge> edges_of(const plane::Contours& contours);

class EdgeGrid {
 public:
  // margin  an edge is listed in every cell nearer to it than this [mm]
  EdgeGrid(std::span<const Edge> edges, double margin);

  std::size_t cell_count() const { return columns_ * rows_; }
  std::span<const std::uint32_t> cell(std::size_t index) const {
    return {members_.data() + starts_[index],
            starts_[index + 1] - starts_[index]};
  }
  std::size_t column_at(double x) const;
  std::size_t row_at(double y) const;

  // Sum of winding numbers around `point` of all loops but `skipped_loop`.
  int winding_number(Vec2 point, std::uint32_t skipped_loop) const;

 private:
  template <typename Visit>
  void visit_cells(const Edge& edge, Visit visit) const;

  std::span<const Edge> edges_;
  double margin_;
  Vec2 low_ = Vec2(0);
  Vec2 cell_size_ = Vec2(1);
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> members_;
};

}  // namespace lamina::support
