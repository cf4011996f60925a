#pragma once
// What of a layer lies over what of the layer below.
//
// A layer parts the plane into regions: **solid** ones, each an outer loop less
// its holes, and **voids**, each a hole less what stands in it, and the
// outside. Two regions of a kind in neighbouring layers **overlap** where their
// insides have an area in common; to touch in a line is none. These overlaps
// are the arcs of the layer graph (layer_graph.h), a Reeb graph of the height.
//
// A ray moves over both layers at once, as in plane/sweep. Chains of one layer
// never cross, so only neighbours from different layers need a certificate:
// half of them, and the order is all that the sweep keeps. Between two
// neighbours on the ray there is one region of each layer. Where the layer
// below is void and the one above is solid the gap is a **ledge**, and a ledge
// that is wider than `reach` is searched for overhangs (overhang_search.h).

#include <cstdint>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "plane/chain_builder.h"
#include "plane/chains.h"
#include "plane/contours.h"
#include "slicer/check/print/overhang_search.h"

namespace lamina::slicer {

// Regions have the number of the loop that goes around them: of an outer loop
// the solid inside, of a hole the void inside.
inline constexpr std::uint32_t kOutside = 0xffffffff;
// Of a loop that is too narrow for the ray: it has no region.
inline constexpr std::uint32_t kNowhere = 0xfffffffe;

// What is narrower than this holds nothing and lets nothing through [mm]: it is
// what simplification may take from a contour, and a twentieth of a fine pixel.
inline constexpr double kContactWidth = 1e-3;

struct Overlap {
  std::uint32_t below = 0;
  std::uint32_t above = 0;

  bool operator==(const Overlap&) const = default;
  auto operator<=>(const Overlap&) const = default;
};

struct LayerOverlay {
  std::vector<Overlap> solids;  // ascending, each once
  std::vector<Overlap> voids;
  // The region around each loop of the layer above: of an outer loop a void, of
  // a hole a solid.
  std::vector<std::uint32_t> around;
  std::vector<double> areas;  // of each of them, signed [mm²]
  // Of regions that overlap a solid below; others are islands as a whole.
  std::vector<Overhang> overhangs;

  void clear();
};

// A layer as chains, in the order of its loops.
class ChainedLayer {
 public:
  // contours  disjoint simple loops, outer ones counter-clockwise and holes
  //           clockwise
  void fill(const plane::Contours& contours);

  plane::LayerChains chains() const { return block_.chains_of(0); }
  std::uint32_t loop_count() const {
    return static_cast<std::uint32_t>(areas_.size());
  }
  bool is_outer(std::uint32_t loop) const { return areas_[loop] > 0; }
  const std::vector<double>& areas() const { return areas_; }

 private:
  plane::ChainBuilder builder_;
  plane::ChainBlock block_;
  std::vector<double> areas_;
};

class OverlaySweep {
 public:
  OverlaySweep();
  ~OverlaySweep();
  OverlaySweep(OverlaySweep&&) noexcept;
  OverlaySweep& operator=(OverlaySweep&&) noexcept;

  // Begins with a layer. It must stay until the next call, as must those of
  // lay_over().
  void start(const plane::Contours& layer);

  // Lays a layer over the one of the call before.
  //
  // reach  how far it may stand out over that [mm]
  // throws GeometryError where the two cross each other so often that it would
  //        take minutes
  void lay_over(const plane::Contours& layer, double reach,
                LayerOverlay& overlay);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::slicer
