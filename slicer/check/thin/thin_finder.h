#pragma once
// Where a layer is thinner than a given width, solid or void.
//
// The width at a place is the diameter of the largest disk that fits in there:
// in the solid a wall, in the void a gap. Its centre is on the medial axis
// (Blum 1967), of which a branch runs into every corner, with disks as small as
// one likes. So a place counts as thin if the disk
//
//   - is thinner than the width,
//   - is empty: no boundary runs through it,
//   - and touches two sides that face each other: where it touches them, they
//     run in opposite directions, but for kFacingAngle.
//
// A corner of 90° is not thin, nor is the foot of a fillet; a plate, a slit, a
// prong, a neck, the end of a taper or of a knife's edge is. Where a disk
// touches three sides of which none face each other (a prong of three or five
// sides), the loop counts as a whole by 4 · area / perimeter, the inscribed
// circle's diameter in every triangle and regular polygon.
//
// Nothing is sampled. A disk rolls along an edge and touches what faces it,
// another edge or a corner that points at it: its radius is a polynomial of its
// place, of first or second degree, and what blocks it does so between roots of
// such polynomials. So widths and places are exact up to rounding.
//
// The cost is about 0.1 µs for an edge that nothing faces, and 1 to 7 µs for an
// edge of a thin place, by how many edges there are within the width.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "slicer/check/thin/facing_cells.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {

enum class ThinKind : std::uint8_t { kWall, kGap };

inline constexpr std::uint32_t kNoInstance =
    std::numeric_limits<std::uint32_t>::max();

// A stretch of the medial axis that is thin.
struct ThinStretch {
  ThinKind kind = ThinKind::kWall;
  double width = 0;                                // least on the stretch [mm]
  Vec2 place = Vec2(0);                            // centre of the disk there
  std::array<Vec2, 2> sides = {Vec2(0), Vec2(0)};  // where it touches
  // The ends of the stretch, which is taken for straight.
  Vec2 from = Vec2(0);
  Vec2 to = Vec2(0);
  double reach = 0;  // radius of the larger disk at the ends [mm]
  // The leaves whose surfaces the sides are, where they are known
  // (LeafSearch): indices into Scene::instances, or kNoInstance.
  std::array<std::uint32_t, 2> instances = {kNoInstance, kNoInstance};

  bool operator==(const ThinStretch&) const = default;
};

// Least and greatest width of a search [mm]: no printer knows finer ones, and
// the cost grows with the square of the width.
inline constexpr double kLeastThinWidth = 1e-3;
inline constexpr double kGreatestThinWidth = 10;

// One object per thread: it owns the scratch that layers share.
class ThinFinder {
 public:
  // width  [mm], kLeastThinWidth … kGreatestThinWidth
  explicit ThinFinder(double width);

  // Replaces `stretches` by those of simple, disjoint loops with the solid on
  // the left.
  void find(const plane::Contours& contours,
            std::vector<ThinStretch>& stretches);

 private:
  // c0 + c1 x + c2 x²
  struct Polynomial {
    double c0 = 0;
    double c1 = 0;
    double c2 = 0;

    double operator()(double x) const { return c0 + x * (c1 + x * c2); }
  };
  struct Range {
    double low = 0;
    double high = 0;

    bool is_empty() const { return !(low <= high); }
    void keep_above(double limit) { low = limit > low ? limit : low; }
    void keep_below(double limit) { high = limit < high ? limit : high; }
    void keep_where_positive(double c0, double c1);  // c0 + c1 x >= 0
  };
  // An edge in the frame of the edge in hand: s along that edge from its
  // beginning, h away from it on the searched side.
  struct Seen {
    std::uint32_t edge = 0;
    double s = 0;  // its beginning
    double h = 0;
    double u = 0;  // its direction: along s
    double v = 0;  // and h
    double length = 0;
  };
  // What faces the edge in hand, and the radius of the disk that touches both
  // as a polynomial of its place x = s - origin on the edge in hand.
  struct Facing {
    std::uint32_t edge = 0;
    bool is_corner = false;  // where that edge begins; else its interior
    double origin = 0;
    Polynomial radius;
    Range range;
  };

  void take_in_hand(std::uint32_t number, ThinKind kind);
  Seen see(std::uint32_t other) const;
  Vec2 in_layer(double s, double h) const;
  void look_around();
  void face_edge(const Seen& seen);
  void face_corner(const Seen& seen);
  void roll(const Facing& facing);
  const LayerEdge* find_blocker(Vec2 centre, double radius);
  Range blocked_range(const LayerEdge& blocker, const Facing& facing,
                      double x) const;
  static double least(const Polynomial& radius, const Range& range);
  static Range range_around(const Polynomial& polynomial, double x);
  void add_stretch(const Facing& facing, const Range& range);
  void face_corners(std::uint32_t number);
  bool points_to(std::uint32_t number, Vec2 direction) const;
  void add_small_loops();

  const double width_;
  std::vector<LayerEdge> edges_;
  FacingCells cells_;
  std::vector<bool> is_thin_;  // each loop
  std::vector<ThinStretch>* stretches_ = nullptr;

  // The edge in hand and the searched side.
  std::uint32_t number_ = 0;
  LayerEdge edge_;
  ThinKind kind_ = ThinKind::kWall;
  double side_ = 1;  // +1: left
  std::vector<std::uint32_t> neighbours_;
  std::vector<Range> ranges_;  // still to be searched
  std::uint32_t last_blocker_ = 0;
};

}  // namespace lamina::slicer
