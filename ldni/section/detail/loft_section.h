#pragma once
// Sections of a parametric sweep, without its vertices or facets.
//
// vertex(i, j) = scale_i · spoke_j + centre_i, where the spokes are the
// outline and the centres the profile's heights, both under the instance's
// matrix. So a ring of vertices reaches from its lowest to its highest spoke,
// and a layer either misses the ring or crosses it. That gives a seed for
// every loop without looking at the vertices:
//
// - Where a layer passes between two neighbouring rings, one wholly below and
//   the other wholly above, the loop runs round the strip between them and
//   crosses every spoke once.
// - Every other loop crosses rings. Where the heights of the outline rise once
//   and fall once (every convex outline), the parts of two rings above the
//   layer are nested, since both are {j : spoke_j.z > limit}; so neighbouring
//   rings that the layer crosses share one loop, and the first ring of such a
//   run gives its seed. The loop leads along the falls of these rings to the
//   last of them and back along their rises, over the spokes between: the fall
//   of a ring is found a few spokes from that of the one before. For other
//   outlines every crossing is a seed of a walk, which marks those it passed.
//
// That walk goes from quad to quad. Sides are planar (csg/scene.h), so a quad
// is one face and gives one edge of the loop: no diagonal, half the points. A
// cap is one polygon: the walk leaves it at the next change of side on the
// cap's ring. That pairs crossings even where a cap is not convex; stretches
// then covered twice, in opposite directions, tie in the kinetic ray.
//
// Whether a vertex is above is decided by LayerGrid's threshold alone, so a
// walk is a permutation of crossings and always returns to its seed.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/lanes.h"
#include "csg/scene.h"
#include "ldni/section/chain_builder.h"

namespace lamina::ldni::detail {

// The sections of one block, as every cut of a leaf sees them.
struct BlockLayers {
  std::uint32_t first = 0;         // of the job's layers
  std::vector<double> heights;     // section_z
  std::vector<double> thresholds;  // LayerGrid::threshold
  double layers_per_mm = 0;        // for a guess; 0 where uneven

  // Number of layers of the block whose threshold is below z.
  std::uint32_t layers_below(double z) const;
};

class SweepSectioner {
 public:
  // Adds the chains of one sweep of one instance.
  //
  // orientation  +1 where the sweep's side quads, in their natural order, are
  //              counter-clockwise from outside the leaf in the world
  void cut(const csg::Sweep& sweep, const Affine& world_from_leaf,
           std::uint32_t instance, std::int32_t orientation,
           const BlockLayers& layers, ChainBuilder& builder);

 private:
  // Layers that cross a ring: [low, high); those from high on are above it.
  struct RingRange {
    std::uint32_t low = 0;
    std::uint32_t high = 0;

    bool holds(std::uint32_t layer) const {
      return layer >= low && layer < high;
    }
  };
  // Side of a quad that a walk enters by: its lower ring (scale_i, height_i),
  // its next spoke, its upper ring, its own spoke.
  enum class Side : std::uint8_t { kLowerRing, kNextSpoke, kUpperRing, kSpoke };
  struct Vertex {
    Lanes xy;
    double z;
  };
  // A ring in the world: from a spoke to its vertex.
  struct Ring {
    double scale;
    Vertex centre;

    Vertex vertex(const Vertex& spoke) const {
      return {both_lanes(scale) * spoke.xy + centre.xy,
              scale * spoke.z + centre.z};
    }
    // Whether every vertex has the x and y of its neighbour on the other ring.
    bool is_upright_to(const Ring& other) const {
      return scale == other.scale &&
             !holds_for_any(centre.xy != other.centre.xy);
    }
  };
  // A place on ring `ring` between spokes `spoke` and the next one.
  struct RingEdge {
    std::uint32_t ring = 0;
    std::uint32_t spoke = 0;

    bool operator==(const RingEdge&) const = default;
  };

  void place(const csg::Sweep& sweep, const Affine& world_from_leaf);
  bool rises_and_falls_once() const;
  void find_ranges();
  void cut_strips();
  void cut_strip(std::uint32_t ring, std::uint32_t upper);
  void cut_strip_layers(std::uint32_t ring, std::uint32_t upper,
                        RingRange layers, std::uint32_t from, std::uint32_t to);
  void add_spoke_points(std::uint32_t strip, std::uint32_t from,
                        std::uint32_t to);
  void cut_runs();
  void cut_run(std::uint32_t first, std::uint32_t layer);
  void cut_round(std::uint32_t layer);
  std::uint32_t pass_falls(std::uint32_t ring, std::uint32_t from);
  std::uint32_t pass_rises(std::uint32_t ring, std::uint32_t from);
  std::uint32_t find_rise(std::uint32_t ring) const;
  std::uint32_t find_fall(std::uint32_t ring) const;

  // The walk (sweep_walk.cpp).
  void cut_all_crossings();
  void find_crossed_edges();
  void trace(RingEdge start, std::uint32_t layer);
  bool pass_strip(RingEdge& edge, std::uint32_t strip, Side entry);
  std::uint32_t leave_first_cap(std::uint32_t spoke) const;
  std::uint32_t leave_last_cap(std::uint32_t spoke) const;
  void mark(RingEdge edge, std::uint32_t layer);

  void begin(std::uint32_t layer);
  void close(std::uint32_t layer);

  bool is_above(std::uint32_t ring, std::uint32_t spoke) const {
    return rings_[ring].vertex(spokes_[spoke]).z > threshold_;
  }
  std::uint32_t next_spoke(std::uint32_t spoke) const {
    return spoke + 1 == spoke_count_ ? 0 : spoke + 1;
  }
  std::uint32_t previous_spoke(std::uint32_t spoke) const {
    return (spoke == 0 ? spoke_count_ : spoke) - 1;
  }
  std::uint32_t next_ring(std::uint32_t ring) const {
    return ring + 1 == ring_count_ ? 0 : ring + 1;
  }
  std::uint32_t previous_ring(std::uint32_t ring) const {
    return (ring == 0 ? ring_count_ : ring) - 1;
  }
  bool has_previous(std::uint32_t ring) const { return ring > 0 || is_closed_; }
  bool has_next(std::uint32_t ring) const {
    return ring + 1 < ring_count_ || is_closed_;
  }
  // Where the section crosses the line between two vertices. A vertex within
  // kOnPlaneDistance of the section is on it: clamp.
  static Vec2 crossing(const Vertex& from, const Vertex& to, double height) {
    const double t =
        std::min(1.0, std::max(0.0, (height - from.z) / (to.z - from.z)));
    return point_of(from.xy + both_lanes(t) * (to.xy - from.xy));
  }
  void add_spoke_point(std::uint32_t ring, std::uint32_t upper,
                       std::uint32_t spoke) {
    builder_->loop().push_back(crossing(rings_[ring].vertex(spokes_[spoke]),
                                        rings_[upper].vertex(spokes_[spoke]),
                                        height_));
  }
  void add_ring_point(RingEdge edge) {
    const Ring& ring = rings_[edge.ring];
    builder_->loop().push_back(crossing(ring.vertex(spokes_[edge.spoke]),
                                        ring.vertex(spokes_[edge.spoke + 1]),
                                        height_));
  }

  // The sweep in hand, placed in the world.
  std::vector<Vertex> spokes_;  // round twice, the lowest first
  std::vector<Ring> rings_;
  std::uint32_t spoke_count_ = 0;
  std::uint32_t ring_count_ = 0;
  bool is_closed_ = false;
  std::uint32_t highest_ = 0;  // spoke
  std::vector<RingRange> ranges_;

  // The loop in hand.
  double height_ = 0;
  double threshold_ = 0;

  // For outlines that rise more than once: the ring edges that layers
  // [low, high) cross, with a flag for each layer whether a walk passed there;
  // edge_indices_[ring · spokes + spoke] finds an edge.
  struct CrossedEdge {
    RingEdge edge;
    RingRange range;
    std::uint32_t first_flag = 0;
  };
  std::vector<CrossedEdge> crossed_edges_;
  std::vector<std::uint32_t> edge_indices_;
  std::vector<bool> is_passed_;

  std::uint32_t instance_ = 0;
  std::int32_t orientation_ = 1;
  const BlockLayers* layers_ = nullptr;
  ChainBuilder* builder_ = nullptr;
};

}  // namespace lamina::ldni::detail
