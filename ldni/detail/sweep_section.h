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
//   run gives its seed. For other outlines every crossing is a seed, and the
//   walk marks those it passed.
//
// The walk goes from quad to quad. Sides are planar (csg/scene.h), so a quad
// is one face and gives one edge of the loop: no diagonal, half the points. A
// cap is one polygon: the walk leaves it at the next change of side on the
// cap's ring. That pairs crossings even where a cap is not convex; stretches
// then covered twice, in opposite directions, tie in the kinetic ray.
//
// Whether a vertex is above is decided by LayerGrid's threshold alone, so a
// walk is a permutation of crossings and always returns to its seed.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"
#include "ldni/detail/chain_builder.h"

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
  };
  // Side of a quad that a walk enters by: its lower ring (scale_i, height_i),
  // its next spoke, its upper ring, its own spoke.
  enum class Side : std::uint8_t { kLowerRing, kNextSpoke, kUpperRing, kSpoke };
  // A ring in the world: from a spoke to its vertex.
  struct Ring {
    double scale;
    Vec3 centre;

    Vec3 vertex(const Vec3& spoke) const { return scale * spoke + centre; }
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
  void cut_strip(std::uint32_t ring, std::uint32_t next_ring);
  void add_strip_points(std::uint32_t ring, std::uint32_t upper);
  void cut_runs();
  void cut_all_crossings();
  void find_crossed_edges();
  void trace(RingEdge start, std::uint32_t layer);
  bool pass_strip(RingEdge& edge, std::uint32_t strip, Side entry);
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
  std::uint32_t find_rise(std::uint32_t ring) const;
  std::uint32_t find_fall(std::uint32_t ring) const;
  std::uint32_t leave_first_cap(std::uint32_t spoke) const;
  std::uint32_t leave_last_cap(std::uint32_t spoke) const;
  void add_ring_point(RingEdge edge);
  void mark(RingEdge edge, std::uint32_t layer);

  // The sweep in hand, placed in the world.
  std::vector<Vec3> spokes_;
  std::vector<Ring> rings_;
  std::uint32_t spoke_count_ = 0;
  std::uint32_t ring_count_ = 0;
  bool is_closed_ = false;
  std::uint32_t lowest_ = 0;  // spoke
  std::uint32_t highest_ = 0;
  bool is_nested_ = false;  // rises_and_falls_once()
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
