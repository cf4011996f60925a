#pragma once
// The Boolean program where only some leaves are known.
//
// Long before each leaf has been asked whether a place is inside of it, the
// program may hold, or fail, whatever the others say: one member of a union
// decides it. As in ProgramState, operators count their children that hold,
// here twice: those that surely do, and those that may.

#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

enum class Knowledge : std::uint8_t { kOutside, kUnknown, kInside };

class ProgramRange {
 public:
  // At first all instances are known to be outside.
  explicit ProgramRange(const Scene& scene);

  // O(1) plus the operators of which more, or less, becomes known.
  void set(std::uint32_t instance, Knowledge knowledge);

  // Whether the program's value depends on nothing that is unknown.
  bool is_decided() const { return is_decided(0); }

  // Whether the program's value may depend on that of the instance: it is
  // unknown, and no operator above it is decided.
  bool matters(std::uint32_t instance) const;

 private:
  // A child's value is from the first to the second.
  struct Range {
    bool surely = false;
    bool maybe = false;
  };
  struct Node {
    // Children that hold, subtrahends counted as -1: at least and at most.
    std::int32_t least = 0;
    std::int32_t most = 0;
    std::int32_t threshold = 1;
    std::uint32_t parent = 0;
    bool is_subtrahend = false;

    Range range() const { return {least >= threshold, most >= threshold}; }
  };
  struct Member {
    std::uint32_t parent = 0;
    bool is_subtrahend = false;
    Knowledge knowledge = Knowledge::kOutside;
  };

  static Range range_of(Knowledge knowledge) {
    return {knowledge == Knowledge::kInside, knowledge != Knowledge::kOutside};
  }
  bool is_decided(std::uint32_t node) const {
    const Range range = nodes_[node].range();
    return range.surely == range.maybe;
  }

  std::vector<Node> nodes_;
  std::vector<Member> members_;
};

}  // namespace lamina::csg
