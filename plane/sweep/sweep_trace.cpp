#include "plane/sweep/sweep_trace.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "plane/program/program_states.h"
#include "plane/sweep/ray_sweep.h"

namespace lamina::plane {
namespace {

using Ray = std::vector<TracedEntry>;

Ray entries_of(const Status& status) {
  Ray ray;
  for (std::uint32_t chain = status.first(); chain != status.sentinel();
       chain = status[chain].above) {
    const Entry& entry = status[chain];
    ray.push_back({chain, entry.is_tied, entry.side, entry.arc});
  }
  return ray;
}

// Compares the ray before and after an event point.
class Comparison {
 public:
  explicit Comparison(std::size_t chain_count)
      : places_before_(chain_count, kNone), places_after_(chain_count, kNone) {}

  void compare(const Ray& before, const Ray& after, TracedEvent& event) {
    note_places(before, places_before_);
    note_places(after, places_after_);
    find_begun_and_ended(before, after, event);
    find_swapped(before, after, event);
    event.tied = pairs_of_first(after, before, places_before_);
    event.parted = pairs_of_first(before, after, places_after_);
    event.arcs_begun = arcs_of_first(after, before, places_before_);
    event.arcs_ended = arcs_of_first(before, after, places_after_);
    cut_out_change(before, after, event);
    for (const TracedEntry& entry : before) places_before_[entry.chain] = kNone;
    for (const TracedEntry& entry : after) places_after_[entry.chain] = kNone;
  }

 private:
  using Places = std::vector<std::uint32_t>;  // by chain; kNone: not there

  static void note_places(const Ray& ray, Places& places) {
    for (std::uint32_t i = 0; i < ray.size(); ++i) places[ray[i].chain] = i;
  }

  void find_begun_and_ended(const Ray& before, const Ray& after,
                            TracedEvent& event) const {
    for (const TracedEntry& entry : after) {
      if (places_before_[entry.chain] == kNone) {
        event.begun.push_back(entry.chain);
      }
    }
    for (const TracedEntry& entry : before) {
      if (places_after_[entry.chain] == kNone) {
        event.ended.push_back(entry.chain);
      }
    }
  }

  // The n-th of those that stay, before and after.
  void find_swapped(const Ray& before, const Ray& after,
                    TracedEvent& event) const {
    auto old = before.begin();
    for (const TracedEntry& entry : after) {
      if (places_before_[entry.chain] == kNone) continue;
      while (places_after_[old->chain] == kNone) ++old;
      if (old->chain != entry.chain) event.swapped.push_back(entry.chain);
      ++old;
    }
  }

  // The tied pairs of the first ray that the second one does not have.
  static std::vector<TracedPair> pairs_of_first(const Ray& first,
                                                const Ray& second,
                                                const Places& places) {
    std::vector<TracedPair> pairs;
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
      if (!first[i].is_tied) continue;
      const TracedPair pair{first[i].chain, first[i + 1].chain};
      const std::uint32_t place = places[pair.lower];
      const bool is_kept = place != kNone && second[place].is_tied &&
                           second[place + 1].chain == pair.upper;
      if (!is_kept) pairs.push_back(pair);
    }
    return pairs;
  }

  static std::vector<TracedEntry> arcs_of_first(const Ray& first,
                                                const Ray& second,
                                                const Places& places) {
    std::vector<TracedEntry> arcs;
    for (const TracedEntry& entry : first) {
      if (entry.side == 0) continue;
      const std::uint32_t place = places[entry.chain];
      const bool is_kept = place != kNone && second[place].side == entry.side &&
                           second[place].arc == entry.arc;
      if (!is_kept) arcs.push_back(entry);
    }
    return arcs;
  }

  static void cut_out_change(const Ray& before, const Ray& after,
                             TracedEvent& event) {
    const std::size_t most = std::min(before.size(), after.size());
    std::size_t below = 0;
    while (below < most && before[below] == after[below]) ++below;
    std::size_t above = 0;
    while (above < most - below && before[before.size() - 1 - above] ==
                                       after[after.size() - 1 - above]) {
      ++above;
    }
    if (below > 0) --below;
    if (above > 0) --above;
    event.has_more_below = below > 0;
    event.has_more_above = above > 0;
    event.ray.assign(after.begin() + static_cast<std::ptrdiff_t>(below),
                     after.end() - static_cast<std::ptrdiff_t>(above));
  }

  Places places_before_;
  Places places_after_;
};

}  // namespace

SweepTrace trace_sweep(const LayerChains& layer, const BooleanProgram& program,
                       const SweepOptions& options) {
  SweepTrace trace;
  ProgramStates states(program, FillRule::kNonZero);
  RaySweep sweep(options);
  sweep.begin(layer, states);
  Comparison comparison(layer.chains.size());
  std::vector<std::uint8_t> was_met(layer.chains.size());
  Ray before;
  while (sweep.step()) {
    Ray after = entries_of(sweep.status());
    TracedEvent event;
    event.left = sweep.cluster().left;
    event.right = sweep.cluster().right;
    comparison.compare(before, after, event);
    for (const std::uint32_t chain : event.begun) was_met[chain] = 1;
    if (after != before) trace.events.push_back(std::move(event));
    before = std::move(after);
  }
  for (std::uint32_t chain = 0; chain < was_met.size(); ++chain) {
    if (was_met[chain] == 0) trace.passed.push_back(chain);
  }
  return trace;
}

}  // namespace lamina::plane
