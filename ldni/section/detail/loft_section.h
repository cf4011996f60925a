#pragma once
// Sections of a parametric loft, without its vertices or facets.
//
// vertex(i, j) = scale_i · outline_j + centre_i, where the outline and the
// centres, the profile's heights, are placed by the instance's matrix. So a
// ring of vertices reaches from the outline's lowest to its highest corner, and
// a layer either misses the ring or crosses it. That gives a seed for every
// loop without looking at the vertices:
//
// - Where a layer passes between two neighbouring rings, one wholly below and
//   the other wholly above, the loop runs round the strip between them and
//   crosses every side edge once.
// - Every other loop crosses rings. Where the outline is monotone, so that its
//   heights ascend once and descend once (every convex outline), the parts of
//   two rings above the layer are nested, since both are
//   {j : outline_j.z > limit}; so neighbouring rings that the layer crosses
//   share one loop, and the first ring of such a run gives its seed. The loop
//   leads along the descending edges of these rings to the last of them and
//   back along their ascending ones. The edge of a ring is found a few corners
//   from that of the ring before. For other outlines every crossing is a seed
//   of a walk, which marks those it passed.
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
#include "ldni/section/detail/mesh_index.h"
#include "plane/chain_builder.h"

namespace lamina::ldni::detail {

// The sections of one block, as every cut of a leaf sees them.
struct BlockLayers {
  std::uint32_t first = 0;         // of the job's layers
  std::vector<double> heights;     // section_z
  std::vector<double> thresholds;  // LayerGrid::threshold
  double layers_per_mm = 0;        // for a guess; 0 where uneven

  LayerSpan span() const {
    return {first, first + static_cast<std::uint32_t>(heights.size())};
  }

  // Number of layers of the block whose threshold is below z.
  std::uint32_t layers_below(double z) const;
};

class LoftSectioner {
 public:
  // Adds the chains of one loft of one instance.
  //
  // orientation  +1 where the loft's side quads, in their natural order, are
  //              counter-clockwise from outside the leaf in the world
  void cut(const csg::Loft& loft, const Affine& world_from_leaf,
           std::uint32_t instance, std::int32_t orientation,
           const BlockLayers& layers, plane::ChainBuilder& builder);

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
  // the side edge at its next corner, its upper ring, that at its own corner.
  enum class Side : std::uint8_t {
    kLowerRing,
    kNextCorner,
    kUpperRing,
    kCorner
  };
  struct Vertex {
    Lanes xy;
    double z;
  };
  // A ring in the world: from a corner of the outline to its vertex.
  struct Ring {
    double scale;
    Vertex centre;

    Vertex vertex(const Vertex& corner) const {
      return {both_lanes(scale) * corner.xy + centre.xy,
              scale * corner.z + centre.z};
    }
    // Whether every vertex has the x and y of its neighbour on the other ring.
    bool is_upright_to(const Ring& other) const {
      return scale == other.scale &&
             !holds_for_any(centre.xy != other.centre.xy);
    }
  };
  // The edge of ring `ring` from corner `corner` to the next one.
  struct RingEdge {
    std::uint32_t ring = 0;
    std::uint32_t corner = 0;

    bool operator==(const RingEdge&) const = default;
  };

  void place(const csg::Loft& loft, const Affine& world_from_leaf);
  bool is_outline_monotone() const;
  void find_ranges();
  void cut_strips();
  void cut_strip(std::uint32_t ring, std::uint32_t upper);
  void cut_strip_layers(std::uint32_t ring, std::uint32_t upper,
                        RingRange layers, std::uint32_t from, std::uint32_t to);
  void add_strip_points(std::uint32_t strip, std::uint32_t from,
                        std::uint32_t to);
  void cut_runs();
  void cut_run(std::uint32_t first, std::uint32_t layer);
  void cut_round(std::uint32_t layer);
  template <bool kStartsAbove>
  std::uint32_t pass_edge(std::uint32_t ring, std::uint32_t edge);
  std::uint32_t find_edge(std::uint32_t ring, std::uint32_t first,
                          std::uint32_t last, bool starts_above) const;
  std::uint32_t find_ascending_edge(std::uint32_t ring) const {
    return find_edge(ring, 0, highest_, false);
  }
  std::uint32_t find_descending_edge(std::uint32_t ring) const {
    return find_edge(ring, highest_, outline_size_, true);
  }

  // The walk (loft_walk.cpp).
  void cut_all_crossings();
  void find_crossed_edges();
  void trace(RingEdge start, std::uint32_t layer);
  bool pass_strip(RingEdge& edge, std::uint32_t strip, Side entry);
  std::uint32_t leave_first_cap(std::uint32_t corner) const;
  std::uint32_t leave_last_cap(std::uint32_t corner) const;
  void mark(RingEdge edge, std::uint32_t layer);

  void begin(std::uint32_t layer);
  void close(std::uint32_t layer);

  bool is_above(std::uint32_t ring, std::uint32_t corner) const {
    return rings_[ring].vertex(outline_[corner]).z > threshold_;
  }
  std::uint32_t next_corner(std::uint32_t corner) const {
    return corner + 1 == outline_size_ ? 0 : corner + 1;
  }
  std::uint32_t previous_corner(std::uint32_t corner) const {
    return (corner == 0 ? outline_size_ : corner) - 1;
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
  // Returns where the section crosses the line between two vertices. A vertex
  // within kOnPlaneDistance of the section is on it: clamp.
  static Vec2 crossing(const Vertex& from, const Vertex& to, double height) {
    const double t =
        std::min(1.0, std::max(0.0, (height - from.z) / (to.z - from.z)));
    return point_of(from.xy + both_lanes(t) * (to.xy - from.xy));
  }
  void add_side_point(std::uint32_t ring, std::uint32_t upper,
                      std::uint32_t corner) {
    builder_->loop().push_back(crossing(rings_[ring].vertex(outline_[corner]),
                                        rings_[upper].vertex(outline_[corner]),
                                        height_));
  }
  void add_ring_point(RingEdge edge) {
    const Ring& ring = rings_[edge.ring];
    builder_->loop().push_back(crossing(ring.vertex(outline_[edge.corner]),
                                        ring.vertex(outline_[edge.corner + 1]),
                                        height_));
  }

  // The loft, placed in the world.
  std::vector<Vertex> outline_;  // round twice, the lowest first
  std::vector<Ring> rings_;
  std::uint32_t outline_size_ = 0;
  std::uint32_t ring_count_ = 0;
  bool is_closed_ = false;
  std::uint32_t highest_ = 0;  // corner
  std::vector<RingRange> ranges_;

  // The layer of the loop.
  double height_ = 0;
  double threshold_ = 0;

  // For outlines that are not monotone: the ring edges that layers
  // [low, high) cross, with a flag for each layer whether a walk passed there;
  // edge_indices_[ring · outline_size_ + corner] finds an edge.
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
  plane::ChainBuilder* builder_ = nullptr;
};

}  // namespace lamina::ldni::detail
