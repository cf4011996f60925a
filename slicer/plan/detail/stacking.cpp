#include "slicer/plan/detail/stacking.h"

#include <algorithm>
#include <limits>

namespace lamina::slicer {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

// Finds the cheapest stack below each border, by the size of its last layer.
class Stacker {
 public:
  Stacker(const Plies& plies, std::uint16_t greatest)
      : plies_(plies), greatest_(greatest) {
    const std::size_t borders = plies.limits.size() + 1;
    costs_.resize(borders * greatest, kImpossible);
    goes_on_.resize(borders * greatest);
    best_sizes_.resize(borders);
  }

  // price  of a run, in layers
  std::vector<std::uint32_t> stack(double price) {
    const auto count = static_cast<std::uint32_t>(plies_.limits.size());
    for (std::uint32_t border = 1; border <= count; ++border) {
      fill(border, price);
    }
    return borders_below(count);
  }

 private:
  std::size_t state(std::uint32_t border, std::uint32_t size) const {
    return std::size_t{border} * greatest_ + size - 1;
  }

  double best_cost(std::uint32_t border) const {
    return border == 0 ? 0 : costs_[state(border, best_sizes_[border])];
  }

  // Prices all layers that end at the border.
  void fill(std::uint32_t border, double price) {
    std::uint32_t limit = std::min<std::uint32_t>(greatest_, border);
    double best = kImpossible;
    for (std::uint32_t size = 1; size <= limit; ++size) {
      const std::uint32_t below = border - size;
      limit = std::min<std::uint32_t>(limit, plies_.limits[below]);
      // What a limit or a border forbids a layer it forbids all larger ones.
      if (size > limit || (size > 1 && plies_.must_part[below + 1])) break;
      const std::size_t here = state(border, size);
      const double after_change = best_cost(below) + price;
      const double after_equal =
          below == 0 ? kImpossible : costs_[state(below, size)];
      goes_on_[here] = after_equal <= after_change;
      costs_[here] = 1 + std::min(after_equal, after_change);
      if (costs_[here] > best) continue;
      best = costs_[here];
      best_sizes_[border] = static_cast<std::uint16_t>(size);
    }
  }

  std::vector<std::uint32_t> borders_below(std::uint32_t border) const {
    std::vector<std::uint32_t> borders = {border};
    std::uint16_t size = best_sizes_[border];
    while (border > 0) {
      const bool goes_on = goes_on_[state(border, size)];
      border -= size;
      borders.push_back(border);
      if (!goes_on) size = best_sizes_[border];
    }
    std::ranges::reverse(borders);
    return borders;
  }

  const Plies& plies_;
  const std::uint16_t greatest_;
  std::vector<double> costs_;
  std::vector<bool> goes_on_;  // the layer below is of the same size
  std::vector<std::uint16_t> best_sizes_;
};

std::size_t count_runs(const std::vector<std::uint32_t>& borders) {
  std::size_t runs = 0;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const bool goes_on =
        i > 1 && borders[i] - borders[i - 1] == borders[i - 1] - borders[i - 2];
    runs += goes_on ? 0 : 1;
  }
  return runs;
}

}  // namespace

std::vector<std::uint32_t> stack_layers(const Plies& plies,
                                        std::uint16_t greatest,
                                        std::size_t most_runs) {
  if (plies.limits.empty()) return {0};
  Stacker stacker(plies, greatest);
  // Where all runs together cost less than a layer, layers alone count.
  double low = 0.5 / static_cast<double>(plies.limits.size() + 1);
  std::vector<std::uint32_t> best = stacker.stack(low);
  if (count_runs(best) <= most_runs) return best;
  // A run that costs more than all layers is the only one.
  double high = 1;
  for (best = stacker.stack(high); count_runs(best) > most_runs;) {
    low = high;
    best = stacker.stack(high *= 2);
  }
  constexpr int kHalvings = 16;
  for (int i = 0; i < kHalvings; ++i) {
    const double price = (low + high) / 2;
    std::vector<std::uint32_t> borders = stacker.stack(price);
    const bool fits = count_runs(borders) <= most_runs;
    (fits ? high : low) = price;
    if (fits) best = std::move(borders);
  }
  return best;
}

}  // namespace lamina::slicer
