#pragma once
// The Boolean program, built while the tree is walked.
//
// Parts (instances and operators) lie on a stack; "the parts above a mark"
// always means their union, so unions need no work at all and nested ones are
// flat from the start. Difference and intersection pop their operands and push
// at most one part. Boxes decide what is empty, conservatively: a part is left
// out only where it cannot matter.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

class ProgramBuilder {
 public:
  void reserve(std::size_t instances) { instances_.reserve(instances); }

  // Height of the stack.
  std::size_t mark() const { return stack_.size(); }

  void push(const Instance& instance);

  // Forgets the parts above the mark.
  void drop(std::size_t mark) { stack_.resize(mark); }

  // Marks the instances above the mark as flat.
  void flatten(std::size_t mark);
  // Forgets what is flat.
  void drop_flat();

  // Replaces the operands by the result of the operator. They are the parts
  // from each begin up to the next one, the last operand's up to the top; an
  // operand may be empty. What is flat counts as empty.
  void apply(plane::BooleanOp op, std::span<const std::size_t> begins);

  // Copies the parts from begin up to end into the scene, box included, as
  // finish() would.
  void copy(std::size_t begin, std::size_t end, Scene& scene) const;

  // Moves instances and program into the scene, box included: the union of all
  // parts on the stack.
  void finish(Scene& scene);

 private:
  void apply_difference(std::span<const std::size_t> begins);
  void apply_intersection(std::span<const std::size_t> begins);

  struct Part {
    std::uint32_t index = 0;  // into instances_ or operators_
    bool is_operator = false;
  };
  struct Operator {
    plane::BooleanOp op = plane::BooleanOp::kUnion;
    std::uint32_t first_child = 0;  // into children_
    std::uint32_t child_count = 0;
    Box3 box;
  };

  bool is_flat(Part part) const {
    return !part.is_operator && instances_[part.index].is_flat;
  }
  const Box3& box_of(Part part) const;
  Box3 box_of(std::span<const Part> parts) const;
  std::span<const Part> parts_above(std::size_t mark) const;
  Part make_operator(plane::BooleanOp op, std::span<const Part> parts,
                     Box3 box);
  Part unite(std::span<const Part> parts, const Box3& box);
  void emit(Part part, std::uint32_t parent, bool is_minuend, Scene& scene);
  void emit_operands(Part part, std::uint32_t self, Scene& scene);

  std::vector<Instance> instances_;
  std::vector<Operator> operators_;
  std::vector<Part> children_;
  std::vector<Part> stack_;
};

}  // namespace lamina::csg
