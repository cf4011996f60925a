#pragma once
// Regions of a plane in exact arithmetic: the judge of lamina's layers.
//
// A region is a set of directed edges between exact points (CGAL's exact
// constructions), the region on their left. All questions are answered the
// same way: put the edges of everything in question into one arrangement, walk
// over its cells from the outermost one, keep count of the winding numbers,
// and ask for each cell what it is. No polygon is ever clipped by another, so
// there are no special cases of polygons that touch or coincide.
//
// Results are regularised: only open cells count. Two cells are one component
// where they share an edge; so two squares that touch at a corner are two
// regions, and two such holes are two holes.

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <string>

#include "csg/scene.h"
#include "plane/contours.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

struct RegionCounts {
  std::size_t regions = 0;  // components of the open interior
  std::size_t holes = 0;    // bounded components of the open exterior

  bool operator==(const RegionCounts&) const = default;
};
std::ostream& operator<<(std::ostream& out, const RegionCounts& counts);

// An immutable exact region.
class ExactRegion {
 public:
  struct Edges;

  ExactRegion();
  explicit ExactRegion(std::shared_ptr<const Edges> edges);

  const Edges& edges() const { return *edges_; }
  std::size_t edge_count() const;

 private:
  std::shared_ptr<const Edges> edges_;
};

// The Boolean of the leaves at height z. Throws std::runtime_error if the
// section of a leaf is not closed.
ExactRegion exact_section(const WorldScene& scene, double z);

// The section of one closed mesh, inside where the winding number is positive.
// Open ends no further apart than `gap` [mm] are joined; others throw.
ExactRegion exact_section(const csg::Mesh& mesh, double z, double gap);

// Where the section of a mesh winds other than 0 or 1 times [mm²]: the mesh
// overlaps itself or is turned inside out.
double overlap_of_section(const csg::Mesh& mesh, double z, double gap);

// Where loops wind at least once.
ExactRegion region_of_loops(const plane::Contours& contours);

RegionCounts count_regions(const ExactRegion& region);

// The exact area as a fraction of two integers, for comparison as text.
std::string exact_area(const ExactRegion& region);

// The region made ready for counting: gaps up to 2·distance closed, then walls
// up to 6·distance taken away, measured along the axes, and all that is left
// one distance smaller. Two regions that differ by less than `distance` then
// count the same, and what touches in a point is apart.
ExactRegion settle(const ExactRegion& region, double distance);

// What lies between the truth and a judged set of loops.
struct Comparison {
  RegionCounts expected_counts;
  RegionCounts actual_counts;
  double expected_area = 0;       // [mm²]
  double actual_area = 0;         // [mm²]
  double expected_perimeter = 0;  // [mm]
  double actual_perimeter = 0;    // [mm]
  double difference_area = 0;     // of the symmetric difference [mm²]
  // Where loops wind other than 0 or 1 times [mm²]: they overlap or run the
  // wrong way.
  double overlap_area = 0;
  // The largest cell of the symmetric difference.
  double worst_area = 0;       // [mm²]
  Vec2 worst_place = Vec2(0);  // a vertex of it
};
Comparison compare(const ExactRegion& expected, const plane::Contours& actual);
Comparison compare(const ExactRegion& expected, const ExactRegion& actual);

}  // namespace lamina::oracle
