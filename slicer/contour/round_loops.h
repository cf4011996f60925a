#pragma once
// Rounds loops to float32 coordinates so that they stay simple and disjoint.
//
// Near 100 mm two float32 numbers are 8e-6 mm apart: rounding each point by
// itself can close a thin wall or gap, or turn a slender corner inside out.
//
// 1. Proof. A point moves by half that spacing, in x and in y. Loops that are
//    apart can only meet if some vertex is nearer than two such moves to a
//    foreign edge. A tree of boxes looks for one (edge_tree.h); hardly ever
//    there is one, and each point goes to its nearest float32.
// 2. Else the layer is snap-rounded (Greene and Yao 1986; Guibas and Marimont
//    1998; Hobby 1999) on a grid of the spacing at the largest coordinate: an
//    edge is routed through the middle of every hot pixel, a cell that holds a
//    vertex, that it meets. This is repeated while an edge meets a foreign hot
//    pixel (iterated snap rounding, Halperin and Packer 2002), so that edges
//    meet in vertices only. The moving ray then leaves out what has fallen
//    together. All that is on integers below 2^24, hence exact. Where some
//    rounds do not do, each edge is routed until none of its parts meets a
//    foreign hot pixel, and loops are linked from what is left
//    (detail/planar_loops.h).

#include <cstdint>
#include <utility>
#include <vector>

#include "plane/contours.h"
#include "plane/edge_tree.h"
#include "plane/point_grid.h"
#include "plane/sweep/loop_resolver.h"

namespace lamina::slicer {

// One object per thread: it owns the scratch that layers share.
class LoopRounder {
 public:
  LoopRounder();

  // Simple, disjoint loops stay so; coordinates become float32 numbers. Loops
  // narrower than their spacing may vanish or be parted.
  //
  // clearance  as of Layer
  // returns    whether that alone did not prove that each point can be rounded
  //            by itself
  bool round(plane::Contours& contours, double clearance = 0);

  // Counts a layer that is equal to the last one.
  void count_again() { snapped_layers_ += has_snapped_ ? 1 : 0; }

  // Layers that were snap-rounded since construction.
  std::uint64_t snapped_layers() const { return snapped_layers_; }

  // The most moves that an edge made, one after another, since construction,
  // each of half a step at most in x and in y.
  int most_moves() const { return most_moves_; }

 private:
  bool is_safe(const plane::Contours& contours);
  bool is_safe_by_grid();
  bool touch(std::uint32_t vertex, std::uint32_t edge) const;
  void snap(plane::Contours& contours);
  bool route_through_hot_pixels(plane::Contours& contours, bool goes_on);
  bool bends_edge(Vec2 from, Vec2 to);
  bool routes_on(Vec2 from, Vec2 to);
  bool find_passages(Vec2 from, Vec2 to);

  double spacing_ = 0;  // of float32 at the layer's largest coordinate [mm]
  // The points of the loops, each closed by a copy of its first point.
  std::vector<Vec2> points_;
  std::vector<std::uint32_t> vertices_;  // all of them
  std::vector<std::uint32_t> ends_;
  plane::EdgeTree tree_;
  std::vector<
      std::pair<const plane::EdgeTree::Bundle*, const plane::EdgeTree::Bundle*>>
      near_pairs_;  // of the tree
  std::vector<std::uint32_t> members_;
  PointGrid grid_;
  std::vector<Vec2> hot_pixels_;  // their middles
  plane::Contours routed_;
  struct Passage {
    double place = 0;  // along the edge
    Vec2 hot_pixel = Vec2(0);
  };
  std::vector<Passage> passages_;
  // A part of an edge that is still to be routed, and the moves that it takes.
  struct Way {
    Vec2 end = Vec2(0);
    int moves = 0;
  };
  std::vector<Way> ways_;  // the next last
  int moves_of_round_ = 1;
  plane::LoopResolver resolver_;
  bool has_snapped_ = false;  // the last layer
  std::uint64_t snapped_layers_ = 0;
  int most_moves_ = 1;
};

}  // namespace lamina::slicer
