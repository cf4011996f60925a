#pragma once
// Features: thin walls and gaps that go on through neighbouring layers.
//
// A layer is thin along stretches of its medial axis, with a disk at every
// point (thin_finder.h). Stretches whose disks overlap belong to one thin
// place, in a layer and from one layer to the next; there disks may also miss
// each other by a layer's thickness, so that a wall that leans by 45° is one
// place however thin.
//
// A thin place that several lines of the design make, as a prong on a thin
// collet is, has as many features: each fault is reported with the line that
// can repair it.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/union_find.h"
#include "base/vec.h"
#include "csg/scene.h"
#include "plane/cell_grid.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

struct ThinFeature {
  ThinKind kind = ThinKind::kWall;
  std::uint32_t first_layer = 0;  // of the written ones, from 1
  std::uint32_t last_layer = 0;
  double bottom = 0;   // of the first layer [mm]
  double top = 0;      // of the last one
  Vec2 low = Vec2(0);  // bounds of its stretches
  Vec2 high = Vec2(0);
  // At its thinnest point; of several, the one on the longest stretch.
  double width = 0;
  double length = 0;  // of the stretch
  std::uint32_t layer = 0;
  double section_z = 0;
  Vec2 place = Vec2(0);
  std::array<std::uint32_t, 2> instances = {kNoInstance, kNoInstance};
  // From the bottom to the top of its thin place [mm].
  double height = 0;
};

// Whether its thin place is lower than it may be wide. Such are the tops of
// domes, the lines where surfaces meet at a slant, and wires that lie flat. A
// place in one layer without thickness is not: its height is not known.
bool is_low(const ThinFeature& feature, double width);

// Whether its sides meet in an edge: it has no width.
bool is_edge(const ThinFeature& feature);

// Tables list features in ascending order of this: the thinnest first, edges
// last.
std::pair<bool, double> rank_of(const ThinFeature& feature);

// "wall" or "gap".
std::string_view name_of(ThinKind kind);

// A number for each instance: equal where one place in the design made them.
std::vector<std::uint32_t> source_ids(const csg::Scene& scene);

class FeatureCollector {
 public:
  // width       that the stretches were found with [mm]
  // source_ids  of source_ids(); empty where leaves are not known
  FeatureCollector(double width, std::vector<std::uint32_t> source_ids);

  // Takes the stretches of the next layer, also where there are none: it counts
  // the layers. It does not look at the layer's contours.
  void take(const Layer& layer, std::span<const ThinStretch> stretches);

  // All features, from the bottom to the top.
  std::vector<ThinFeature> finish();

 private:
  // A stretch, its feature and its thin place.
  struct Member {
    Vec2 from;
    Vec2 to;
    double reach;
    ThinKind kind;
    std::uint64_t sources;  // ids of both sides, whatever their order
    std::uint32_t feature;
    std::uint32_t thin_place;
  };
  // The stretches of a layer by place: each in the cells that its line passes.
  class StretchGrid {
   public:
    // stretches  all that may be added; they make the cells
    // least      side of a cell [mm]
    void clear(std::span<const ThinStretch> stretches, double least);
    // Returns the member's number.
    std::uint32_t add(const Member& member);
    std::span<Member> members() { return members_; }
    std::uint32_t number_of(const Member& member) const {
      return static_cast<std::uint32_t>(&member - members_.data());
    }
    // Calls visit(member) for all whose disks are within the distance of the
    // line, and for some beyond.
    template <typename Visit>
    void visit_near(Vec2 from, Vec2 to, double distance, const Visit& visit);

   private:
    struct Item {
      std::uint32_t member;
      std::uint32_t next;
    };

    CellGrid grid_;
    double greatest_reach_ = 0;
    std::vector<Member> members_;
    std::vector<std::uint32_t> heads_;  // of each cell, in items_
    std::vector<Item> items_;
    std::vector<std::uint32_t> last_visits_;  // that each member was in
    std::uint32_t visit_ = 0;
  };
  struct Span {
    double bottom = 0;
    double top = 0;
  };

  ThinFeature feature_of(const ThinStretch& stretch, const Layer& layer) const;
  Member member_of(const ThinStretch& stretch) const;
  void take_again(const Layer& layer);
  std::uint32_t join_neighbours(Member& member, double gap);
  std::uint32_t join_features(std::uint32_t a, std::uint32_t b);
  std::uint32_t join_thin_places(std::uint32_t a, std::uint32_t b);
  void count(const ThinFeature& one, Member& member);

  const double width_;
  const std::vector<std::uint32_t> source_ids_;
  std::uint32_t layers_ = 0;
  double last_z_ = 0;
  std::vector<ThinStretch> last_stretches_;
  // Where the last two layers had the same stretches: by how much disks of the
  // two may miss each other and have been joined [mm].
  double joined_gap_ = -1;
  // The members of here_ that stand for them: the disk in the middle of a wire
  // of n sides comes with some n² / 12 pairs of sides that face each other.
  std::vector<std::uint32_t> numbers_;
  StretchGrid here_;
  StretchGrid below_;
  UnionFind feature_union_;
  std::vector<ThinFeature> features_;
  std::vector<std::uint32_t> thin_place_of_;  // each feature
  UnionFind thin_place_union_;
  std::vector<Span> thin_places_;
};

// The features of a single layer.
std::vector<ThinFeature> find_thin_features(const Layer& layer, double width);

}  // namespace lamina::slicer
