#pragma once
// A Boolean of regions of the plane: operators and operands, and nothing of
// what the operands are.
//
// The program is the Boolean tree as an array. An operand is whatever has
// closed loops in a layer: a leaf of a scene, an outline, the contours that an
// earlier sweep made. Of it only four facts count: where it can be, the
// operator that it belongs to, whether that subtracts it, and whether it may
// overlap itself. csg::program_of() makes the program of a scene.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::plane {

enum class BooleanOp : std::uint8_t { kUnion, kIntersection, kDifference };

// One operator. Children (operators and operands alike) name their parent;
// parents come before their children, the root is 0.
struct BooleanNode {
  BooleanOp op = BooleanOp::kUnion;
  std::uint32_t parent = 0;  // of the root: 0
  bool is_minuend = false;   // this node is the first child of its parent
  std::uint32_t child_count = 0;
};

struct Operand {
  Box2 box;                  // around all of it
  std::uint32_t parent = 0;  // index into BooleanProgram::nodes
  bool is_minuend = false;   // first child of a difference
  // false: each crossing of its loops toggles inside and outside; true: loops
  // may overlap, so winding must be counted.
  bool may_overlap_itself = false;
};

struct BooleanProgram {
  std::vector<BooleanNode> nodes;  // never empty: a union of nothing
  std::vector<Operand> operands;
};

// The program of one operator. The first operand is its minuend; none has a box
// or may overlap itself.
inline BooleanProgram program_of(BooleanOp op, std::uint32_t operand_count) {
  BooleanProgram program{{{op, 0, false, operand_count}}, {}};
  program.operands.resize(operand_count);
  if (operand_count > 0) program.operands[0].is_minuend = true;
  return program;
}

// Whether the child, an operand or an operator, is subtracted by its parent:
// then its weight is -1.
template <typename Child>
bool is_subtrahend(std::span<const BooleanNode> nodes, const Child& child) {
  return nodes[child.parent].op == BooleanOp::kDifference && !child.is_minuend;
}

// The weighted number of children that must hold for the operator to hold. An
// intersection of nothing is empty, as in OpenSCAD.
inline std::int32_t threshold_of(const BooleanNode& node) {
  return node.op == BooleanOp::kIntersection && node.child_count > 1
             ? static_cast<std::int32_t>(node.child_count)
             : 1;
}

// Which points are inside an operand that may overlap itself, by the winding
// number of a point: the sum of the turns that the loops make around it,
// counter-clockwise ones counted positive.
enum class FillRule : std::uint8_t { kNonZero, kPositive, kEvenOdd };

constexpr bool is_inside(std::int32_t winding_number, FillRule rule) {
  switch (rule) {
    case FillRule::kNonZero:
      return winding_number != 0;
    case FillRule::kPositive:
      return winding_number > 0;
    case FillRule::kEvenOdd:
      break;
  }
  return winding_number % 2 != 0;
}

}  // namespace lamina::plane
