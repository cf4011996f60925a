#include "csg/lower/detail/program_builder.h"

#include <limits>
#include <utility>

namespace lamina::csg {
namespace {

constexpr std::uint32_t kNoParent = std::numeric_limits<std::uint32_t>::max();

// Boxes that only touch have no volume in common.
bool have_common_volume(const Box3& a, const Box3& b) {
  Box3 common = a;
  common.intersect(b);
  return glm::all(glm::lessThan(common.low, common.high));
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
  for (const Part part : parts) box.add(box_of(part));
  return box;
}

std::span<const ProgramBuilder::Part> ProgramBuilder::parts_above(
    std::size_t mark) const {
  return std::span(stack_).subspan(mark);
}

ProgramBuilder::Part ProgramBuilder::make_operator(plane::BooleanOp op,
                                                   std::span<const Part> parts,
                                                   Box3 box) {
  const auto first = static_cast<std::uint32_t>(children_.size());
  children_.insert(children_.end(), parts.begin(), parts.end());
  operators_.push_back(
      {op, first, static_cast<std::uint32_t>(parts.size()), box});
  return {static_cast<std::uint32_t>(operators_.size() - 1), true};
}

ProgramBuilder::Part ProgramBuilder::unite(std::span<const Part> parts,
                                           const Box3& box) {
  if (parts.size() == 1) return parts[0];
  return make_operator(plane::BooleanOp::kUnion, parts, box);
}

void ProgramBuilder::flatten(std::size_t mark) {
  for (const Part part : parts_above(mark)) {
    if (!part.is_operator) instances_[part.index].is_flat = true;
  }
}

void ProgramBuilder::drop_flat() {
  std::erase_if(stack_, [&](Part part) { return is_flat(part); });
}

void ProgramBuilder::apply(plane::BooleanOp op,
                           std::span<const std::size_t> begins) {
  if (begins.size() < 2) return;
  if (op == plane::BooleanOp::kDifference) {
    apply_difference(begins);
  } else if (op == plane::BooleanOp::kIntersection) {
    apply_intersection(begins);
  }
}

void ProgramBuilder::apply_difference(std::span<const std::size_t> begins) {
  const std::size_t mark = begins[0];
  const auto all = parts_above(mark);
  std::vector<Part> minuend;
  for (const Part part : all.first(begins[1] - mark)) {
    if (!is_flat(part)) minuend.push_back(part);
  }
  if (minuend.empty()) return drop(mark);

  // Keep the subtrahends that can reach the minuend; a union of them is as
  // good as each of them in turn.
  const Box3 box = box_of(minuend);
  std::vector<Part> operands{{}};
  for (const Part part : all.subspan(begins[1] - mark)) {
    if (is_flat(part)) continue;
    if (have_common_volume(box, box_of(part))) operands.push_back(part);
  }
  drop(mark);
  if (operands.size() == 1) {
    stack_.insert(stack_.end(), minuend.begin(), minuend.end());
    return;
  }
  operands.front() = unite(minuend, box);
  stack_.push_back(make_operator(plane::BooleanOp::kDifference, operands, box));
}

void ProgramBuilder::apply_intersection(std::span<const std::size_t> begins) {
  const std::size_t mark = begins[0];
  const auto operand = [&](std::size_t i) {
    const std::size_t end =
        i + 1 < begins.size() ? begins[i + 1] : stack_.size();
    return std::span<const Part>(stack_).subspan(begins[i], end - begins[i]);
  };
  Box3 box = box_of(operand(0));
  for (std::size_t i = 1; i < begins.size(); ++i) {
    box.intersect(box_of(operand(i)));
  }

  // What does not reach the overlap of all boxes has no part in the result.
  std::vector<Part> operands;
  std::vector<Part> kept;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    kept.clear();
    for (const Part part : operand(i)) {
      if (is_flat(part)) continue;
      if (have_common_volume(box, box_of(part))) kept.push_back(part);
    }
    if (kept.empty()) return drop(mark);
    operands.push_back(unite(kept, box));
  }
  drop(mark);
  stack_.push_back(
      make_operator(plane::BooleanOp::kIntersection, operands, box));
}

void ProgramBuilder::emit(Part part, std::uint32_t parent, bool is_minuend,
                          Scene& scene) {
  if (!part.is_operator) {
    Instance& instance = instances_[part.index];
    instance.parent = parent;
    instance.is_minuend = is_minuend;
    return;
  }
  const plane::BooleanOp op = operators_[part.index].op;
  const auto self = static_cast<std::uint32_t>(scene.program.size());
  scene.program.push_back({op, parent, is_minuend, 0});
  emit_operands(part, self, scene);
}

void ProgramBuilder::emit_operands(Part part, std::uint32_t self,
                                   Scene& scene) {
  const Operator& node = operators_[part.index];
  const bool is_difference = node.op == plane::BooleanOp::kDifference;
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    const Part child = children_[node.first_child + i];
    // (A - B) - C is A - B - C, A ∩ (B ∩ C) is A ∩ B ∩ C.
    const bool is_dissolved = child.is_operator &&
                              operators_[child.index].op == node.op &&
                              !(is_difference && i > 0);
    if (is_dissolved) {
      emit_operands(child, self, scene);
    } else {
      emit(child, self, is_difference && scene.program[self].child_count == 0,
           scene);
      ++scene.program[self].child_count;
    }
  }
}

void ProgramBuilder::copy(std::size_t begin, std::size_t end,
                          Scene& scene) const {
  ProgramBuilder part = *this;
  const auto parts = parts_above(begin).first(end - begin);
  part.stack_.assign(parts.begin(), parts.end());
  part.finish(scene);
}

void ProgramBuilder::finish(Scene& scene) {
  const auto all = parts_above(0);
  scene.box = box_of(all);
  const bool is_operator = all.size() == 1 && all[0].is_operator;
  const Part root =
      is_operator ? all[0]
                  : make_operator(plane::BooleanOp::kUnion, all, scene.box);
  scene.program.clear();
  emit(root, 0, false, scene);
  std::erase_if(instances_, [](const Instance& instance) {
    return instance.parent == kNoParent;
  });
  scene.instances = std::move(instances_);
}

}  // namespace lamina::csg
