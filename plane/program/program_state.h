#pragma once
// The Boolean program of a program, evaluated by counters.
//
// A point that moves along a ray enters and leaves one leaf at a time. So every
// operator counts its children that hold; a flip of one leaf changes the count
// of its parent, and only where that changes the parent's own value does the
// walk towards the root go on. All three operators are the same test,
//     weighted number of children that hold >= threshold,
// with threshold 1 for a union, the number of children for an intersection,
// and 1 for a difference whose subtrahends weigh -1.

#include <cstdint>
#include <span>
#include <vector>

#include "plane/program/boolean_program.h"

namespace lamina::plane {

// The value of the program for one set of operands. Starts with the
// empty set, which no program holds for.
class ProgramState {
 public:
  explicit ProgramState(const BooleanProgram& program);

  // Puts `operand` into the set or takes it out; it must not be there (or be
  // gone) already. O(1) plus the operators whose value changes.
  void flip(std::uint32_t operand, bool now_inside) {
    note_membership(operand, now_inside);
    const Child leaf = operands_[operand].child;
    std::int32_t change = now_inside ? leaf.weight() : -leaf.weight();
    std::uint32_t index = leaf.parent();
    for (;;) {
      Node& node = nodes_[index];
      const bool held = node.count >= node.threshold;
      node.count += change;
      const bool holds = node.count >= node.threshold;
      if (holds == held || index == 0) return;
      change = holds ? node.child.weight() : -node.child.weight();
      index = node.child.parent();
    }
  }

  // Whether the program holds for the present set.
  bool value() const { return value(0); }

  // Whether a subtree of the program holds for it.
  bool value(std::uint32_t node) const {
    return nodes_[node].count >= nodes_[node].threshold;
  }
  // Children of the node that hold, subtrahends counted as -1.
  std::int32_t count(std::uint32_t node) const { return nodes_[node].count; }

  bool is_inside(std::uint32_t operand) const {
    return operands_[operand].position != kOutside;
  }
  // The present set, in no particular order; changed by every flip.
  std::span<const std::uint32_t> inside() const { return inside_; }

  // Back to the empty set, in O(its size).
  void reset();

 private:
  // A child as its parent sees it: parent index and weight in one word.
  class Child {
   public:
    Child() = default;
    Child(std::uint32_t parent, bool is_subtrahend)
        : bits_(parent << 1 | (is_subtrahend ? 1U : 0U)) {}
    std::uint32_t parent() const { return bits_ >> 1; }
    std::int32_t weight() const {
      return 1 - 2 * static_cast<std::int32_t>(bits_ & 1);
    }

   private:
    std::uint32_t bits_ = 0;
  };
  struct Node {
    std::int32_t count = 0;
    std::int32_t threshold = 1;
    Child child;
  };
  struct OperandState {
    Child child;
    std::uint32_t position = kOutside;  // in inside_
  };
  static constexpr std::uint32_t kOutside = 0xffffffff;

  void note_membership(std::uint32_t operand, bool now_inside) {
    std::uint32_t& position = operands_[operand].position;
    if (now_inside) {
      position = static_cast<std::uint32_t>(inside_.size());
      inside_.push_back(operand);
      return;
    }
    const std::uint32_t last = inside_.back();
    inside_[position] = last;
    operands_[last].position = position;
    position = kOutside;
    inside_.pop_back();
  }

  std::vector<Node> nodes_;
  std::vector<OperandState> operands_;
  std::vector<std::uint32_t> inside_;
};

}  // namespace lamina::plane
