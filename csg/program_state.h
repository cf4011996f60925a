#pragma once
// The Boolean program of a scene, evaluated by counters.
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

#include "csg/scene.h"

namespace lamina::csg {

// Whether the child, an instance or an operator, is subtracted by its parent:
// then its weight is -1.
template <typename Child>
bool is_subtrahend(const Scene& scene, const Child& child) {
  return scene.program[child.parent].op == BooleanOp::kDifference &&
         !child.is_minuend;
}

// An intersection of nothing is empty, as in OpenSCAD.
inline std::int32_t threshold_of(const BooleanNode& node) {
  return node.op == BooleanOp::kIntersection && node.child_count > 1
             ? static_cast<std::int32_t>(node.child_count)
             : 1;
}

// The value of the program for one set of leaf instances. Starts with the
// empty set, which no program holds for.
class ProgramState {
 public:
  explicit ProgramState(const Scene& scene);

  // Puts `instance` into the set or takes it out; it must not be there (or be
  // gone) already. O(1) plus the operators whose value changes.
  void flip(std::uint32_t instance, bool now_inside) {
    note_membership(instance, now_inside);
    const Child leaf = instances_[instance].child;
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

  // The same for a subtree of the program.
  bool value(std::uint32_t node) const {
    return nodes_[node].count >= nodes_[node].threshold;
  }
  // Children of the node that hold, subtrahends counted as -1.
  std::int32_t count(std::uint32_t node) const { return nodes_[node].count; }

  bool is_inside(std::uint32_t instance) const {
    return instances_[instance].position != kOutside;
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
  struct InstanceState {
    Child child;
    std::uint32_t position = kOutside;  // in inside_
  };
  static constexpr std::uint32_t kOutside = 0xffffffff;

  void note_membership(std::uint32_t instance, bool now_inside) {
    std::uint32_t& position = instances_[instance].position;
    if (now_inside) {
      position = static_cast<std::uint32_t>(inside_.size());
      inside_.push_back(instance);
      return;
    }
    const std::uint32_t last = inside_.back();
    inside_[position] = last;
    instances_[last].position = position;
    position = kOutside;
    inside_.pop_back();
  }

  std::vector<Node> nodes_;
  std::vector<InstanceState> instances_;
  std::vector<std::uint32_t> inside_;
};

}  // namespace lamina::csg
