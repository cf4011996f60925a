#pragma once
// The event queue of the moving ray (Bentley and Ottmann 1979), less the
// endpoints of chains, which are sorted beforehand (chain_endpoints.h).
//
// A certificate (certificate.h) ends in one of two ways. Where it fails is an
// event, and a heap holds these. Where it is valid until some x, it has to be
// renewed there: it waits with the slab in which it ends, and costs nothing
// until the ray gets there. A slab is the strip between two neighbouring rays
// at the pitch. A pair is looked at about once a slab, a straight pair only
// where it ends. So the pitch steers speed and nothing else.
//
// Whatever separates a pair changes the stamp of its lower entry: stale events
// are recognised when they come up and never searched for.

#include <cstdint>
#include <vector>

#include "plane/order/certificate.h"
#include "plane/order/status.h"

namespace lamina::plane {

// A pair of neighbours by its lower entry; stale where the entry's stamp is
// another one.
struct PairRef {
  std::uint32_t entry = 0;
  std::uint32_t stamp = 0;
};

class EventQueue {
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

  // Queues the failure of a pair's certificate, or its renewal.
  void schedule(PairRef pair, const Certificate& certificate);

  // x of the next failure; kNever where none is known.
  double next_failure() const {
    return failures_.empty() ? kNever : failures_.front().x;
  }
  PairRef take_failure();

  // Calls renew(pair) for each pair whose certificate ends in this slab.
  template <typename Renew>
  void visit_renewals(const Renew& renew) {
    for (std::uint32_t i = lists_[slab_]; i != kNone;) {
      const Renewal renewal = renewals_[i];
      i = renewal.next;
      renew(renewal.pair);
    }
  }

 private:
  struct Failure {
    double x = 0;
    PairRef pair;
  };
  struct Renewal {
    PairRef pair;
    std::uint32_t next = kNone;  // of the same slab
  };

  static bool comes_later(const Failure& a, const Failure& b) {
    return a.x > b.x;
  }
  bool is_last_slab() const { return slab_ + 1 == slab_count_; }
  double start_of(std::uint32_t slab) const { return low_ + slab * width_; }

  double low_ = 0;
  double width_ = 0;
  double slabs_per_mm_ = 0;
  std::uint32_t slab_count_ = 0;
  std::uint32_t slab_ = 0;
  std::vector<Failure> failures_;     // a heap, the next one in front
  std::vector<std::uint32_t> lists_;  // first renewal of each slab
  std::vector<Renewal> renewals_;
};

}  // namespace lamina::plane
