#pragma once
// The sets of leaves that contain an interval of the ray, and the value of the
// Boolean program for each.
//
// A layer has few different sets and meets them again and again, at every stop
// and in the next layer. So a set is kept once and known by a number: equal
// sets have equal numbers, the program is evaluated once a set, and passing a
// chain is one look into a table of known steps. Entries of the ray hold a
// number, however many leaves overlap there.
//
// A set is told by a hash that a step changes in O(1), and remembers the step
// that it was first met by. Its members are written down when its value is
// asked for, which is never for the many sets between chains that tie.
//
// A step passes a chain upwards. It toggles the leaf; for a leaf that may
// overlap itself it adds the chain's winding to the leaf's count, and the leaf
// contains the interval where the count is not 0, or, on demand, positive.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/program_state.h"
#include "csg/scene.h"

namespace lamina::ldni::detail {

class LeafSets {
 public:
  using Id = std::uint32_t;
  using Step = std::uint32_t;
  static constexpr Id kEmpty = 0;

  // Which counts of a leaf that may overlap itself are inside it.
  enum class Rule : std::uint8_t { kNonZero, kPositive };

  LeafSets(const csg::Scene& scene, Rule rule);

  // The step of passing a chain of `instance` upwards.
  Step step_of(std::uint32_t instance, std::int32_t winding) const {
    const bool is_backwards = is_counted_[instance] && winding < 0;
    return instance << 1 | (is_backwards ? 1U : 0U);
  }

  // Whether the leaf may overlap itself.
  bool is_counted(std::uint32_t instance) const {
    return is_counted_[instance];
  }

  Id after(Id set, Step step) {
    const std::uint64_t key = std::uint64_t{set} << 32 | step;
    for (std::size_t i = slot_of(key);; i = (i + 1) & (steps_.size() - 1)) {
      if (steps_[i].key == key) return steps_[i].result;
      if (steps_[i].key == kFree) return make_step(set, step);
    }
  }

  // Whether the solid fills what lies in this set.
  bool value(Id set) {
    if (values_[set] == Value::kUnknown) evaluate(set);
    return values_[set] == Value::kSolid;
  }

  std::size_t size() const { return sets_.size(); }
  // Evaluations of the program since construction.
  std::uint64_t evaluations() const { return evaluations_; }

  // What the known sets cost in memory, in leaves written down (8 bytes each).
  std::size_t cost() const {
    return members_.size() + sizeof(Set) / sizeof(Member) * sets_.size();
  }

  // Forgets every set but the empty one.
  void clear();
  // Forgets every set but the empty one and those in `live`, and renumbers
  // them there.
  void keep_only(std::vector<Id>& live);

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
  struct Set {
    Hash hash;
    Id base = kEmpty;  // the set and the step that led here first
    Step step = 0;
    std::uint32_t size = 0;  // of its members, once they are written
    std::size_t first_member = 0;
  };
  // Known from when the members are written.
  enum class Value : std::uint8_t { kUnknown, kEmpty, kSolid };
  struct KnownStep {
    std::uint64_t key = kFree;  // set and step
    Id result = 0;
  };
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  static constexpr Id kNone = 0xffffffff;

  std::size_t slot_of(std::uint64_t key) const {
    return (key * 0x9e3779b97f4a7c15U) >> shift_;
  }
  Id make_step(Id set, Step step);
  Hash hash_after(Id set, Step step) const;
  Id find_or_add(const Hash& hash, Id base, Step step);
  void add_to_index(Id id);
  void evaluate(Id id);
  void write_members(Id id);
  std::int32_t& count_of(std::uint32_t instance);
  bool is_inside(const Member& member) const {
    return rule_ == Rule::kNonZero ? member.count != 0 : member.count > 0;
  }
  void insert_step(Id set, Step step, Id result);
  void grow_steps();
  void grow_index();

  const Rule rule_;
  csg::ProgramState program_;
  std::vector<bool> is_counted_;  // an instance
  std::vector<Set> sets_;
  std::vector<Value> values_;    // of sets_
  std::vector<Member> members_;  // of all evaluated sets
  std::vector<Id> index_;        // open hash of sets_
  std::vector<KnownStep> steps_;
  std::size_t step_count_ = 0;
  int shift_ = 0;
  // Of the set in evaluation: for each instance the evaluation that last met
  // it, and its count there; and the instances met.
  std::vector<std::uint64_t> marks_;
  std::vector<std::int32_t> counts_;
  std::vector<std::uint32_t> met_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace lamina::ldni::detail
