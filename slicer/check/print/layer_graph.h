#pragma once
// The layer graph: which regions of neighbouring layers hang together, and what
// that says about the print.
//
// Its nodes are the solid regions and the voids of the layers, its arcs their
// overlaps (layer_overlay.h). It is built while layers come by, from the bottom
// to the top: regions that hang together so far are a component (union-find),
// and only the last layer's regions are kept, with what was found.
//
//   island       solid region above the first layer with no arc downwards:
//                resin in mid-air
//   loose part   component of solid that reaches neither bed nor another one;
//                where it begins is no island besides
//   overhang     part of a solid region that is farther than its reach from
//                all that is solid below. It hangs by a weak bond where it
//                reaches far and its region lies on little
//   suction cup  void that no way leads out of through the layers built so far.
//                Parts hang from the plate, which closes what opens to the bed;
//                what opens only higher up is closed by the film
//   resin trap   void that no way leads out of at all
//
// What is narrower than kContactWidth in all layers is no finding. What hardens
// no pixel is minor: its greatest layer is smaller than one, or a strip
// narrower than half of one.
//
// A layer with the contours of the one before changes nothing but heights. One
// that begins above the end of the layer before lies over nothing.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/union_find.h"
#include "base/vec.h"
#include "plane/cell_grid.h"
#include "slicer/check/print/layer_overlay.h"
#include "slicer/check/print/print_rules.h"
#include "slicer/check/print/touching_boxes.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

// An island no larger than this that the next layer joins is the lowest part of
// a curve [mm²]: six pixels square of a usual printer. What it lacks is
// hardened through the layer that joins it.
inline constexpr double kPeakArea = 0.1;

// A region that reaches out farther than this is weak if it lies on what is
// below with a smaller share of its area than that. The usual tip of a support
// holds so far [mm] (hold_radius() in slicer/supports); the share is the one
// from which UVtools takes a region to be held.
inline constexpr double kFarReach = 2.4;
inline constexpr double kWeakBond = 0.25;

// "island", "loose part", …
std::string_view name_of(FindingKind kind);

struct Finding {
  FindingKind kind = FindingKind::kIsland;
  // Too small to matter: the peak of a curve that the next layer joins, a pit.
  bool is_minor = false;
  std::uint32_t first_layer = 0;  // from 1
  std::uint32_t last_layer = 0;   // of an island: in which it hangs free
  double bottom = 0;              // of the first layer [mm]
  double top = 0;                 // of the last one
  // A place inside it, in that layer: of an overhang the one farthest from what
  // holds it.
  Vec2 place = Vec2(0);
  std::uint32_t layer = 0;
  double section_z = 0;
  // The greatest area of a layer; of an island that of its first layer, of an
  // overhang that of all layers together [mm²].
  double area = 0;
  double volume = 0;  // of loose parts, cups and traps [mm³]
  // Of a layer, as twice the area over the perimeter: that of a long strip,
  // half the side of a square. The greatest, or one that is enough to matter.
  // Overhangs have none [mm].
  double width = 0;
  double distance = 0;  // of an overhang, to what holds it [mm]
  // Of an overhang: the share of its region that lies on what is below, the
  // least of all layers, where it reaches far.
  double bond = 1;
  Box3 box;
  // An island that another part reaches: then in layer last_layer + 1.
  bool is_joined = false;
  std::uint32_t instance = kNoInstance;  // what made it, where that is known

  bool is_weak() const { return bond < kWeakBond; }
};

// "0.0356 mm², held from layer 72 on": how much of it there is.
std::string size_text(const Finding& finding);

// What the machine has to pull off, layer by layer.
struct Peel {
  double greatest_area = 0;  // cured in one layer [mm²]
  std::uint32_t layer = 0;   // from 1
  double greatest_jump = 0;  // more than in the layer before [mm²]
  std::uint32_t jump_layer = 0;
};

struct PrintCheck {
  std::vector<Finding> findings;  // from the bottom to the top
  Peel peel;

  // Of a kind, without minor ones.
  std::size_t count(FindingKind kind) const;
  std::size_t count_minor() const;
  // "2 islands, 1 resin trap": of these kinds, without minor ones; empty where
  // there are none.
  std::string counts(const std::set<FindingKind>& kinds) const;
};

// How far a layer may stand out over the one below [mm].
//
// self_supporting  as the user says; 0: as a surface of 45° does
// rise             between the sections of the two layers [mm]
double reach_of(double self_supporting, double rise);

// How far a layer begins above the end of the one below [mm]; less than 0 where
// the two overlap, and 0 where they touch or one has no thickness.
//
// bottom, top  of each layer [mm]
double gap_between(double bottom_below, double top_below, double bottom,
                   double top);

class LayerGraph {
 public:
  explicit LayerGraph(const PrintRules& rules);

  // Takes the next layer.
  //
  // overlay  of this layer over the one before, if somebody has made it
  void take(const Layer& layer, const LayerOverlay* overlay);

  // The findings. Nothing may be taken afterwards.
  PrintCheck finish();

 private:
  // A part of the solid so far, or of a void.
  struct Component {
    std::uint32_t parent = 0;  // union-find
    bool is_anchored = false;  // solid: to the bed; void: open to the outside
    bool touches_bed = false;  // a void that only the plate closes
    Finding finding;           // what it is as long as it is not anchored
    std::uint32_t island = kNone;  // in findings_, until it is joined
  };
  static constexpr std::uint32_t kNone = 0xffffffff;

  void lay(const Layer& layer, const LayerOverlay* overlay);
  void measure_regions(const LayerOverlay& overlay);
  void take_solids(const Layer& layer, const LayerOverlay& overlay);
  void take_voids(const Layer& layer, const LayerOverlay& overlay);
  void take_area(double area);
  plane::Contours contours_of(const Layer& layer, std::uint32_t region) const;
  double width_of(const Layer& layer, std::uint32_t region) const;
  double bond_of(const Layer& layer, std::uint32_t region) const;
  void take_overhangs(const Layer& layer, const LayerOverlay& overlay);
  void extend(const Layer& layer);
  Finding begin_finding(FindingKind kind, const Layer& layer) const;
  std::uint32_t add_component(const Finding& finding);
  std::uint32_t root_of(std::uint32_t component);
  std::uint32_t join_solids(std::uint32_t a, std::uint32_t b);
  std::uint32_t join_voids(std::uint32_t a, std::uint32_t b);
  void end_island(std::uint32_t component);
  void add_cup(const Component& component);
  bool is_below_pixel(const Finding& finding) const;
  void join_overhangs(std::uint32_t a, std::uint32_t b);

  const PrintRules rules_;
  const double least_width_;  // of what matters: of half a pixel [mm]
  OverlaySweep sweep_;
  LayerOverlay own_overlay_;
  std::uint32_t layers_ = 0;
  plane::Contours last_;  // of the layer before
  double last_bottom_ = 0;
  double last_top_ = 0;
  double last_z_ = 0;
  double last_area_ = 0;
  // By loop of the last layer: what is around it, and of the region that has
  // its number the area and the component (kNone: too narrow).
  std::vector<std::uint32_t> around_;
  CellLists<std::uint32_t> standing_in_;  // the loops in each region
  std::vector<double> areas_;
  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> next_members_;  // of the layer in hand
  std::vector<Component> components_;        // the first is the outside
  std::vector<Finding> findings_;
  std::vector<Finding> overhangs_;
  UnionFind overhang_sets_;  // those that are one
  // The overhangs of the last layer: their boxes, wider by half of what may lie
  // between two that are one, and their numbers in overhangs_.
  std::vector<Box2> patches_;
  std::vector<std::uint32_t> patch_overhangs_;
  TouchingBoxes touching_;
  Peel peel_;
};

}  // namespace lamina::slicer
