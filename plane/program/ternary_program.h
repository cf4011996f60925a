#pragma once
// The Boolean program where only some leaves are known.
//
// Over a box, or before each leaf has been asked, a leaf is known to hold,
// known to fail, or unknown. The program may be decided all the same: one
// member of a union decides it. As in ProgramState, operators count their
// children that hold, here twice: those that surely do, and those that may.
// Source: null-object detection by three-valued evaluation, Tilove, "A
// null-object detection algorithm for constructive solid geometry", 1984.

#include <cstdint>
#include <vector>

#include "plane/program/boolean_program.h"

namespace lamina::plane {

enum class Ternary : std::uint8_t { kFalse, kUnknown, kTrue };

class TernaryProgram {
 public:
  // At first all operands have the value `initial`.
  TernaryProgram(const BooleanProgram& program, Ternary initial);

  // O(1) plus the operators of which more, or less, becomes known.
  void set(std::uint32_t operand, Ternary value);

  Ternary value(std::uint32_t operand) const { return members_[operand].value; }

  // Whether the value of a node, by default of the whole program, depends on
  // nothing that is unknown.
  bool is_decided(std::uint32_t node = 0) const {
    const Range range = nodes_[node].range();
    return range.surely == range.maybe;
  }

  // Whether the program's value may depend on that of the operand: it is
  // unknown, and no operator above it is decided.
  bool matters(std::uint32_t operand) const;

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
    Ternary value = Ternary::kFalse;
  };

  static Range range_of(Ternary value) {
    return {value == Ternary::kTrue, value != Ternary::kFalse};
  }

  std::vector<Node> nodes_;
  std::vector<Member> members_;
};

}  // namespace lamina::plane
