#pragma once
// The edges of a set of contours by place: which one is nearest to a point.
//
// Successive edges lie near each other, so a tree of boxes over them needs no
// sorting: some edges make a bundle, some bundles the box above them, and so
// on.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "plane/predicates.h"

namespace lamina::slicer {

class EdgeTree {
 public:
  struct Edge {
    Vec2 from;
    Vec2 to;
  };

  explicit EdgeTree(const plane::Contours& contours);

  const std::vector<Edge>& edges() const { return edges_; }

  double distance(std::size_t edge, Vec2 point) const {
    return distance_to_segment(point, edges_[edge].from, edges_[edge].to);
  }

  // The nearest edge, or any that is no farther than `enough` [mm]. There must
  // be one.
  //
  // guess  any edge; the search is the faster the nearer it is
  std::size_t nearest(Vec2 point, std::size_t guess, double enough) const;

  // Lowers `best`, the distance of some edge that the caller knows of [mm], to
  // that of the nearest one, which becomes the guess; or to that of any that is
  // no farther than `enough`.
  void lower(Vec2 point, double enough, double& best, std::size_t& guess) const;

 private:
  static constexpr std::size_t kFanOut = 6;

  void follow(Vec2 point, double enough, std::size_t& edge,
              double& its_distance) const;

  std::vector<Edge> edges_;
  // Boxes of kFanOut edges each, of kFanOut of these boxes each, and so on up
  // to a single one.
  std::vector<std::vector<Box2>> levels_;
};

}  // namespace lamina::slicer
