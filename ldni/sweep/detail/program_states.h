#pragma once
// The states of the Boolean program: set membership classification (Tilove
// 1980) for all gaps of the ray at once.
//
// The state of a gap between two entries stands for all that the program can
// ever ask of it. The ray sees no leaves: passing a chain upwards leads from a
// state to another one, and a state is solid or not. A layer meets few states,
// and meets them again at every event point and in the next layer. So a state
// is kept once and known by a number: the program is evaluated once a state,
// and a crossing is one look-up in a hash table of known crossings.
//
// A state is identified by the set of leaves that contain the gap, through a
// hash that a crossing changes in O(1). It remembers the crossing by which it
// was first met; the members of its set are written down when its value is
// asked for, which never happens for the many states between chains that tie.
//
// A crossing toggles the leaf. If the leaf may overlap itself, it adds the
// chain's winding to the leaf's count, and the leaf contains the gap where the
// count is not 0, or positive, as the rule says.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/program_state.h"
#include "csg/scene.h"

namespace lamina::ldni::detail {

class ProgramStates {
 public:
  using State = std::uint32_t;
  using Crossing = std::uint32_t;
  // Of what no leaf contains; never solid.
  static constexpr State kOutside = 0;

  // Which counts of a leaf that may overlap itself are inside it.
  enum class Rule : std::uint8_t { kNonZero, kPositive };

  ProgramStates(const csg::Scene& scene, Rule rule);

  // The crossing of a chain of `instance`, upwards.
  Crossing crossing_of(std::uint32_t instance, std::int32_t winding) const {
    const bool is_backwards = may_overlap_itself_[instance] && winding < 0;
    return instance << 1 | (is_backwards ? 1U : 0U);
  }
  bool may_overlap_itself(std::uint32_t instance) const {
    return may_overlap_itself_[instance];
  }

  State state_above(State state, Crossing crossing) {
    const std::uint64_t key = key_of(state, crossing);
    for (std::size_t i = slot_of(key);; i = (i + 1) & (crossings_.size() - 1)) {
      if (crossings_[i].key == key) return crossings_[i].above;
      if (crossings_[i].key == kFree) return make_state(state, crossing);
    }
  }

  bool is_solid(State state) {
    if (values_[state] == Value::kUnknown) evaluate(state);
    return values_[state] == Value::kSolid;
  }

  // Evaluations of the program since construction.
  std::uint64_t evaluations() const { return evaluations_; }

  // Forgets the states of earlier layers where they are too many; only while
  // nobody holds one but kOutside.
  void begin_layer();
  // Whether it is time to call keep_only().
  bool is_full() const { return cost() > most_cost_; }
  // Forgets every state but kOutside and those that `live` points to, and
  // renumbers them there.
  void keep_only(std::span<State* const> live);

 private:
  struct Member {
    std::uint32_t instance = 0;
    std::int32_t count = 1;
  };
  // Of the members that toggle, and of those that are counted. 128 bits of
  // each: no two of a billion sets will ever be taken for one.
  struct Hash {
    std::array<std::uint64_t, 2> toggled{};
    std::array<std::uint64_t, 2> counted{};

    bool operator==(const Hash&) const = default;
    std::size_t slot() const { return toggled[0] ^ counted[0]; }
  };
  struct Record {
    Hash hash;
    State base = kOutside;  // the state and the crossing that first led here
    Crossing crossing = 0;
    std::uint32_t size = 0;  // of its members, once they are written
    std::size_t first_member = 0;
  };
  // Known from when the members are written.
  enum class Value : std::uint8_t { kUnknown, kEmpty, kSolid };
  struct KnownCrossing {
    std::uint64_t key = kFree;  // of the state below and the crossing
    State above = kOutside;
  };
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  static constexpr State kNone = 0xffffffff;

  static std::uint64_t key_of(State state, Crossing crossing) {
    return std::uint64_t{state} << 32 | crossing;
  }
  std::size_t slot_of(std::uint64_t key) const {
    return (key * 0x9e3779b97f4a7c15U) >> shift_;
  }
  // What all states take in memory, in members written down (8 bytes each).
  std::size_t cost() const {
    return members_.size() + sizeof(Record) / sizeof(Member) * records_.size();
  }
  void clear();
  State make_state(State below, Crossing crossing);
  Hash hash_above(State state, Crossing crossing) const;
  State find_or_add(const Hash& hash, State base, Crossing crossing);
  void index_records(std::size_t capacity);
  void evaluate(State state);
  void write_members(State state);
  void count(std::uint32_t instance, std::int32_t change);
  bool is_inside(const Member& member) const {
    return rule_ == Rule::kNonZero ? member.count != 0 : member.count > 0;
  }
  void insert_crossing(State below, Crossing crossing, State above);
  void grow_crossings();

  const Rule rule_;
  csg::ProgramState program_;
  std::vector<bool> may_overlap_itself_;  // an instance
  std::vector<Record> records_;           // of the states
  std::vector<Value> values_;             // of the states
  std::vector<Member> members_;           // of all states evaluated
  std::vector<State> index_;              // open hash of records_
  std::vector<KnownCrossing> crossings_;  // open hash
  std::size_t crossing_count_ = 0;
  int shift_ = 0;
  // Of the set in evaluation: for each instance the evaluation that last met
  // it, and its count there; and the instances met.
  std::vector<std::uint64_t> marks_;
  std::vector<std::int32_t> counts_;
  std::vector<std::uint32_t> met_;
  std::uint64_t evaluations_ = 0;
  std::size_t first_layer_states_ = 0;  // 0: not yet known
  std::size_t most_cost_ = 0;
};

}  // namespace lamina::ldni::detail
