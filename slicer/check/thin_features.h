#pragma once
// Features: thin walls and gaps that go on through neighbouring layers.
//
// What is thin in one layer is a piece of middle line with a disk at every
// point. Pieces whose disks overlap belong together, in one layer and from one
// layer to the next; there disks may also miss each other by a layer's
// thickness, so that a wall that leans by 45° is one feature however thin.
//
// Pieces that belong together make a thin place. Where it is made by different
// lines of the design, as a prong on a thin collet is, it is as many features:
// a fault is told by the line that it can be mended in.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"
#include "slicer/check/thin_finder.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

struct ThinFeature {
  ThinKind kind = ThinKind::kWall;
  std::uint32_t first_layer = 0;  // of the written ones, from 1
  std::uint32_t last_layer = 0;
  double bottom = 0;   // of the first layer [mm]
  double top = 0;      // of the last one
  Vec2 low = Vec2(0);  // bounds of the middle line
  Vec2 high = Vec2(0);
  // Where it is thinnest, and of such places the one on the longest stretch.
  double width = 0;
  double length = 0;  // of the stretch
  std::uint32_t layer = 0;
  double section_z = 0;
  Vec2 place = Vec2(0);
  std::array<std::uint32_t, 2> instances = {kNoInstance, kNoInstance};
  // From the lowest layer to the highest of the thin place that this is a
  // feature of [mm].
  double height = 0;
};

// Numbers for the lines of a design, by instance: equal where instances were
// made by the same text.
std::vector<std::uint32_t> number_makers(const csg::Scene& scene);

class FeatureCollector {
 public:
  // width   that the stretches were found with [mm]
  // makers  as of number_makers(); empty where nothing is known of leaves
  FeatureCollector(double width, std::vector<std::uint32_t> makers);

  // Takes the stretches of the next layer, none included; it counts layers
  // itself. The layer's contours are not looked at.
  void take(const Layer& layer, std::span<const ThinStretch> stretches);

  // All features, from the bottom to the top.
  std::vector<ThinFeature> finish();

 private:
  // Things that turn out to be one: a forest.
  class Union {
   public:
    std::uint32_t add();
    std::uint32_t root_of(std::uint32_t i);
    // Makes one of two; returns the root, which is the first of them.
    std::uint32_t join(std::uint32_t a, std::uint32_t b);

   private:
    std::vector<std::uint32_t> parents_;
  };
  // A stretch, and what it was counted to.
  struct Placed {
    Vec2 from;
    Vec2 to;
    double reach;
    ThinKind kind;
    std::uint64_t makers;  // both, whatever their order
    std::uint32_t feature;
    std::uint32_t whole;  // the thin place
  };
  // The stretches of a layer by where they are.
  class Places {
   public:
    // cell   size of the grid: about the distance that will be asked for
    // count  of stretches to come
    void clear(double cell, std::size_t count);
    void add(const Placed& placed);
    // Calls visit(placed) for all whose disks are within the distance of the
    // line, and for some beyond; for some more than once.
    template <typename Visit>
    void visit_near(Vec2 from, Vec2 to, double distance,
                    const Visit& visit) const;

   private:
    struct Item {
      std::uint32_t placed;
      std::uint32_t next;
    };
    template <typename Visit>
    void visit_samples(Vec2 from, Vec2 to, const Visit& visit) const;
    std::size_t bucket_of(std::int64_t column, std::int64_t row) const;

    double cell_ = 1;
    double greatest_reach_ = 0;
    std::vector<Placed> placed_;
    std::vector<std::uint32_t> heads_;
    std::vector<Item> items_;
  };
  struct Span {
    double bottom = 0;
    double top = 0;
  };

  Placed place(const ThinStretch& stretch) const;
  void find_neighbours(Placed& stretch, double gap);
  std::uint32_t join_features(std::uint32_t a, std::uint32_t b);
  std::uint32_t join_wholes(std::uint32_t a, std::uint32_t b);
  void count(const ThinFeature& one, Placed& placed);

  const double width_;
  const std::vector<std::uint32_t> makers_;
  std::uint32_t layers_ = 0;
  double last_z_ = 0;
  Places here_;
  Places below_;
  Union features_union_;
  std::vector<ThinFeature> features_;
  std::vector<std::uint32_t> whole_of_;  // a feature
  Union wholes_union_;
  std::vector<Span> wholes_;
};

// Features of a layer by itself.
std::vector<ThinFeature> find_thin_features(const Layer& layer, double width);

}  // namespace lamina::slicer
