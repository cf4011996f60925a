#include "plane/sweep/region_areas.h"

#include "base/diagnostic.h"
#include "plane/chain_builder.h"
#include "plane/sweep/gap_sweep.h"

namespace lamina::plane {
namespace {

// Swaps of neighbours, at most: they take a minute.
constexpr std::uint64_t kMostSwaps = 200'000'000;

// Faces are winding numbers of the two sets; below all chains they are 0.
class Areas : public GapVisitor {
 public:
  explicit Areas(std::span<const Chain> chains) : chains_(chains) {}

  void measure(const LayerChains& layer) { sweep_.sweep(layer, *this); }

  Faces above(std::uint32_t chain, Faces below) override {
    below[chains_[chain].operand] +=
        static_cast<std::uint32_t>(chains_[chain].winding);
    return below;
  }
  void take(const Gap& gap) override {
    if (sweep_.swaps() > kMostSwaps) {
      throw GeometryError("contours cross each other too often to be compared");
    }
    double doubled = 0;
    visit_parts(gap, [&](const ChainCursor&, const ChainCursor&, double left,
                         double right, double width, double next) {
      doubled += (right - left) * (width + next);
      return true;
    });
    sums_[(gap.faces[0] != 0 ? 1U : 0U) + (gap.faces[1] != 0 ? 2U : 0U)] +=
        doubled / 2;
  }

  RegionAreas areas() const { return {sums_[3], sums_[1], sums_[2]}; }

 private:
  std::span<const Chain> chains_;
  GapSweep sweep_{kClusterWidth};
  std::array<double, 4> sums_{};
};

}  // namespace

RegionAreas measure_regions(const Contours& a, const Contours& b) {
  ChainBlock block;
  block.layer_count = 1;
  ChainBuilder builder;
  builder.begin(block);
  const auto add = [&](const Contours& contours, std::uint32_t set) {
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      builder.loop().assign(loop.begin(), loop.end());
      builder.close_loop(0, set, 1);
    }
  };
  add(a, 0);
  add(b, 1);
  builder.finish(block);
  Areas areas(block.chains);
  areas.measure(block.chains_of(0));
  return areas.areas();
}

}  // namespace lamina::plane
