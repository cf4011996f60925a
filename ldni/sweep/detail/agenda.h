#pragma once
// When the ray has to look at a pair of neighbours again.
//
// A look at a pair tells either where its relation changes next or up to where
// it does not. The first is a stop to come, kept in a heap. The second is kept
// with the slab in which the look ends, and costs nothing until the ray gets
// there: a slab is the strip between two neighbouring rays at the pitch, and a
// pair is looked at about once a slab, a straight pair only where it ends. So
// the pitch steers speed and nothing else.

#include <cstdint>
#include <vector>

#include "ldni/sweep/detail/outlook.h"
#include "ldni/sweep/detail/status.h"

namespace lamina::ldni::detail {

// A pair, by its lower entry; stale where the stamp is no longer that of the
// entry's outlook.
struct PairRef {
  std::uint32_t entry = 0;
  std::uint32_t outlook = 0;
};

class Agenda {
 public:
  // Forgets everything; slabs divide [low, high] evenly.
  void begin(double low, double high, std::uint32_t slab_count);

  // The slab that the ray is in. The last one has no end.
  std::uint32_t slab() const { return slab_; }
  double slab_start() const { return start_of(slab_); }
  double slab_end() const {
    return is_last_slab() ? kNever : start_of(slab_ + 1);
  }
  void enter_next_slab() { ++slab_; }

  // Notes an outlook of a pair.
  void note(PairRef pair, const Outlook& outlook);

  // Where the next change is; infinite where none is known.
  double next_change() const {
    return changes_.empty() ? kNever : changes_.front().x;
  }
  PairRef take_change();

  // Calls look(pair) for each pair whose outlook ends in this slab.
  template <typename Look>
  void visit_slab(const Look& look) {
    for (std::uint32_t i = lists_[slab_]; i != kNone;) {
      const Renewal renewal = renewals_[i];
      i = renewal.next;
      look(renewal.pair);
    }
  }

 private:
  struct Change {
    double x = 0;
    PairRef pair;
  };
  struct Renewal {
    PairRef pair;
    std::uint32_t next = kNone;  // of the same slab
  };

  static bool comes_later(const Change& a, const Change& b) {
    return a.x > b.x;
  }
  bool is_last_slab() const { return slab_ + 1 == slab_count_; }
  double start_of(std::uint32_t slab) const { return low_ + slab * width_; }

  double low_ = 0;
  double width_ = 0;
  double slabs_per_mm_ = 0;
  std::uint32_t slab_count_ = 0;
  std::uint32_t slab_ = 0;
  std::vector<Change> changes_;       // a heap, the next one in front
  std::vector<std::uint32_t> lists_;  // first renewal of each slab
  std::vector<Renewal> renewals_;
};

}  // namespace lamina::ldni::detail
