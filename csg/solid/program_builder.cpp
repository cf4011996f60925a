#include "csg/solid/detail/program_builder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "csg/solid/detail/leaf_box.h"

namespace lamina::csg {
namespace {

constexpr std::uint32_t kNoParent = std::numeric_limits<std::uint32_t>::max();

// Boxes that only touch have no volume in common.
bool have_common_volume(const Box3& a, const Box3& b) {
  const Box3 common = intersect_boxes(a, b);
  return common.low.x < common.high.x && common.low.y < common.high.y &&
         common.low.z < common.high.z;
}

}  // namespace

void ProgramBuilder::push(const Instance& instance) {
  stack_.push_back({static_cast<std::uint32_t>(instances_.size()), false});
  instances_.push_back(instance);
  instances_.back().parent = kNoParent;
}

const Box3& ProgramBuilder::box_of(Part part) const {
  return part.is_operator ? operators_[part.index].box
                          : instances_[part.index].box;
}

Box3 ProgramBuilder::box_of(std::span<const Part> parts) const {
  Box3 box;
  for (const Part part : parts) box = unite_boxes(box, box_of(part));
  return box;
}

std::span<const ProgramBuilder::Part> ProgramBuilder::parts_above(
    std::size_t mark) const {
  return std::span(stack_).subspan(mark);
}

bool ProgramBuilder::is_single(std::span<const Part> parts,
                               BooleanOp op) const {
  return parts.size() == 1 && parts[0].is_operator &&
         operators_[parts[0].index].op == op;
}

ProgramBuilder::Part ProgramBuilder::make_operator(BooleanOp op,
                                                   std::span<const Part> parts,
                                                   Box3 box) {
  const auto first = static_cast<std::uint32_t>(children_.size());
  children_.insert(children_.end(), parts.begin(), parts.end());
  operators_.push_back(
      {op, first, static_cast<std::uint32_t>(parts.size()), box});
  return {static_cast<std::uint32_t>(operators_.size() - 1), true};
}

ProgramBuilder::Part ProgramBuilder::unite(std::span<const Part> parts) {
  if (parts.size() == 1) return parts[0];
  return make_operator(BooleanOp::kUnion, parts, box_of(parts));
}

void ProgramBuilder::apply_difference(std::span<const std::size_t> begins) {
  if (begins.size() < 2) return;
  const std::size_t mark = begins[0];
  const auto all = parts_above(mark);
  const auto minuend = all.first(begins[1] - mark);
  if (minuend.empty()) return drop(mark);

  // Keep the subtrahends that can reach the minuend; a union of them is as
  // good as each of them in turn.
  const Box3 box = box_of(minuend);
  std::vector<Part> operands;
  for (const Part part : all.subspan(minuend.size())) {
    if (have_common_volume(box, box_of(part))) operands.push_back(part);
  }
  if (operands.empty()) return drop(begins[1]);

  // (A - B) - C is A - B - C.
  std::vector<Part> head;
  if (is_single(minuend, BooleanOp::kDifference)) {
    const Operator& inner = operators_[minuend[0].index];
    const auto first = children_.begin() + inner.first_child;
    head.assign(first, first + inner.child_count);
  } else {
    head.push_back(unite(minuend));
  }
  operands.insert(operands.begin(), head.begin(), head.end());
  drop(mark);
  stack_.push_back(make_operator(BooleanOp::kDifference, operands, box));
}

void ProgramBuilder::apply_intersection(std::span<const std::size_t> begins) {
  if (begins.size() < 2) return;
  const std::size_t mark = begins[0];
  std::vector<Part> operands;
  Box3 box;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const std::size_t end =
        i + 1 < begins.size() ? begins[i + 1] : stack_.size();
    const auto parts =
        std::span<const Part>(stack_).subspan(begins[i], end - begins[i]);
    if (parts.empty()) return drop(mark);
    const Box3 operand_box = box_of(parts);
    if (i == 0) {
      box = operand_box;
    } else if (have_common_volume(box, operand_box)) {
      box = intersect_boxes(box, operand_box);
    } else {
      return drop(mark);
    }
    // A ∩ (B ∩ C) is A ∩ B ∩ C.
    if (is_single(parts, BooleanOp::kIntersection)) {
      const Operator& inner = operators_[parts[0].index];
      const auto first = children_.begin() + inner.first_child;
      operands.insert(operands.end(), first, first + inner.child_count);
    } else {
      operands.push_back(unite(parts));
    }
  }
  drop(mark);
  stack_.push_back(make_operator(BooleanOp::kIntersection, operands, box));
}

void ProgramBuilder::emit(Part part, std::uint32_t parent, bool is_minuend,
                          Scene& scene) {
  if (!part.is_operator) {
    Instance& instance = instances_[part.index];
    instance.parent = parent;
    instance.is_minuend = is_minuend;
    return;
  }
  const Operator& node = operators_[part.index];
  const auto self = static_cast<std::uint32_t>(scene.program.size());
  scene.program.push_back({node.op, parent, is_minuend, node.child_count});
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    emit(children_[node.first_child + i], self,
         node.op == BooleanOp::kDifference && i == 0, scene);
  }
}

void ProgramBuilder::finish(Scene& scene) {
  const auto all = parts_above(0);
  scene.box = box_of(all);
  const bool is_operator = all.size() == 1 && all[0].is_operator;
  const Part root =
      is_operator ? all[0] : make_operator(BooleanOp::kUnion, all, scene.box);
  scene.program.clear();
  emit(root, 0, false, scene);
  std::erase_if(instances_, [](const Instance& instance) {
    return instance.parent == kNoParent;
  });
  scene.instances = std::move(instances_);
}

}  // namespace lamina::csg
