#include "bench/section_rival/layer_boolean.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lamina::rival {
namespace {

using plane::BooleanOp;

// Whether the outline comes near the box.
bool reaches(std::span<const Loop> outline, const IntBox& box) {
  for (const Loop& loop : outline) {
    if (!loop.box.meets(box)) continue;
    const Path& path = *loop.path;
    const IntPoint* last = &path.back();
    for (const IntPoint& point : path) {
      const auto [low_y, high_y] = std::minmax(last->Y, point.Y);
      if (low_y <= box.high.Y && high_y >= box.low.Y) {
        const auto [low_x, high_x] = std::minmax(last->X, point.X);
        if (low_x <= box.high.X && high_x >= box.low.X) return true;
      }
      last = &point;
    }
  }
  return false;
}

// Of the loops around a point that is not on them: what a ray along +x meets.
int winding_number(std::span<const Loop> loops, const IntPoint& at) {
  int winding = 0;
  for (const Loop& loop : loops) {
    if (at.Y < loop.box.low.Y || at.Y > loop.box.high.Y) continue;
    const IntPoint* a = &loop.path->back();
    for (const IntPoint& b : *loop.path) {
      const bool is_up = b.Y > at.Y;
      if (is_up != (a->Y > at.Y)) {
        const double side =
            static_cast<double>(b.X - a->X) * static_cast<double>(at.Y - a->Y) -
            static_cast<double>(at.X - a->X) * static_cast<double>(b.Y - a->Y);
        if ((side > 0) == is_up) winding += is_up ? 1 : -1;
      }
      a = &b;
    }
  }
  return winding;
}

}  // namespace

void LayerBoolean::Operand::add(const Loop& loop) {
  loops.push_back(loop);
  box.add(loop.box);
}

void LayerBoolean::Operand::add(Operand& value) {
  if (value.is_empty()) return;
  if (is_empty()) {
    std::swap(*this, value);
    return;
  }
  is_outline = false;
  loops.insert(loops.end(), value.loops.begin(), value.loops.end());
  box.add(value.box);
}

void LayerBoolean::Operand::clear() {
  loops.clear();
  box = IntBox();
  is_outline = true;
}

LayerBoolean::LayerBoolean(const csg::Scene& scene) : scene_(scene) {
  for (const plane::BooleanNode& node : scene.program) {
    nodes_.push_back({node.op, {}, {}});
    if (node.op != BooleanOp::kIntersection) {
      nodes_.back().operands.resize(node.op == BooleanOp::kUnion ? 1 : 2);
    }
    if (nodes_.size() > 1) {
      nodes_.back().parent = take_slot(node.parent, node.is_minuend);
    }
  }
  for (const csg::Instance& instance : scene.instances) {
    slots_.push_back(take_slot(instance.parent, instance.is_minuend));
  }
}

LayerBoolean::Slot LayerBoolean::take_slot(std::uint32_t parent,
                                           bool is_minuend) {
  Node& node = nodes_[parent];
  switch (node.op) {
    case BooleanOp::kUnion:
      return {parent, 0};
    case BooleanOp::kDifference:
      return {parent, is_minuend ? 0U : 1U};
    case BooleanOp::kIntersection:
      break;
  }
  node.operands.emplace_back();
  return {parent, static_cast<std::uint32_t>(node.operands.size() - 1)};
}

void LayerBoolean::add(std::uint32_t instance, const std::vector<Loop>& loops) {
  const Slot slot = slots_[instance];
  Operand& operand = nodes_[slot.node].operands[slot.operand];
  const csg::Leaf& leaf = scene_.leaves[scene_.instances[instance].leaf];
  operand.is_outline = operand.is_empty() && !leaf.may_overlap_itself;
  for (const Loop& loop : loops) operand.add(loop);
}

// Parents stand before their children.
void LayerBoolean::run(std::vector<const Path*>& result) {
  pool_.clear();
  for (std::size_t i = nodes_.size(); i-- > 1;) {
    const Slot slot = nodes_[i].parent;
    nodes_[slot.node].operands[slot.operand].add(evaluate(nodes_[i]));
    for (Operand& operand : nodes_[i].operands) operand.clear();
  }
  Operand& value = evaluate(nodes_[0]);
  if (!value.is_outline) {
    Operand nothing;
    clip(ClipperLib::ctUnion, value, nothing);
  }
  result.clear();
  for (const Loop& loop : value.loops) result.push_back(loop.path);
  for (Operand& operand : nodes_[0].operands) operand.clear();
}

LayerBoolean::Operand& LayerBoolean::evaluate(Node& node) {
  switch (node.op) {
    case BooleanOp::kUnion:
      break;
    case BooleanOp::kDifference:
      if (!node.operands[1].is_empty()) {
        clip(ClipperLib::ctDifference, node.operands[0], node.operands[1]);
      }
      break;
    case BooleanOp::kIntersection:
      return intersect(node);
  }
  return node.operands[0];
}

LayerBoolean::Operand& LayerBoolean::intersect(Node& node) {
  Operand& value = node.operands[0];
  for (std::size_t i = 1; i < node.operands.size(); ++i) {
    clip(ClipperLib::ctIntersection, value, node.operands[i]);
  }
  return value;
}

// Replaces `left` by the outline of what `type` leaves of it.
void LayerBoolean::clip(ClipperLib::ClipType type, Operand& left,
                        Operand& right) {
  std::erase_if(right.loops,
                [&](const Loop& loop) { return !loop.box.meets(left.box); });
  if (right.is_empty() && left.is_outline &&
      type != ClipperLib::ctIntersection) {
    return;
  }
  result_.clear();
  together_.clear();
  sort_into_groups(left.loops);
  for (const Group& group : groups_) {
    const std::span<const Loop> loops(left.loops.data() + group.begin,
                                      group.end - group.begin);
    if (reaches(right.loops, group.box)) {
      together_.insert(together_.end(), loops.begin(), loops.end());
      continue;
    }
    const bool is_in_right =
        winding_number(right.loops, loops[0].path->front()) != 0;
    if (is_in_right != (type == ClipperLib::ctIntersection)) continue;
    if (loops.size() == 1 || left.is_outline) {
      for (const Loop& loop : loops) result_.add(loop);
    } else {
      clip_together(ClipperLib::ctUnion, loops, {});
    }
  }
  if (!together_.empty()) clip_together(type, together_, right.loops);
  std::swap(left, result_);
}

// Sorts the loops into groups whose boxes hang together.
void LayerBoolean::sort_into_groups(std::vector<Loop>& loops) {
  join_neighbours(loops);
  const auto size = static_cast<std::uint32_t>(loops.size());
  groups_.clear();
  rank_.assign(size, size);
  for (std::uint32_t i = 0; i < size; ++i) {
    std::uint32_t& rank = rank_[group_of(i)];
    if (rank == size) {
      rank = static_cast<std::uint32_t>(groups_.size());
      groups_.push_back({0, 0, {}});
    }
    ++groups_[rank].end;
    groups_[rank].box.add(loops[i].box);
  }
  std::uint32_t begin = 0;
  for (Group& group : groups_) {
    const std::uint32_t count = group.end;
    group.begin = group.end = begin;
    begin += count;
  }
  sorted_.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    sorted_[groups_[rank_[group_of(i)]].end++] = loops[i];
  }
  std::swap(loops, sorted_);
}

// Gives loops whose boxes meet one leader; a sweep along x finds them.
void LayerBoolean::join_neighbours(std::vector<Loop>& loops) {
  std::sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return a.box.low.X < b.box.low.X;
  });
  leader_.resize(loops.size());
  std::iota(leader_.begin(), leader_.end(), 0U);
  reach_.clear();
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    std::erase_if(reach_, [&](std::uint32_t other) {
      return loops[other].box.high.X < loops[i].box.low.X;
    });
    for (const std::uint32_t other : reach_) {
      if (loops[other].box.meets(loops[i].box)) {
        leader_[group_of(other)] = group_of(i);
      }
    }
    reach_.push_back(i);
  }
}

std::uint32_t LayerBoolean::group_of(std::uint32_t loop) {
  while (leader_[loop] != loop) {
    leader_[loop] = leader_[leader_[loop]];
    loop = leader_[loop];
  }
  return loop;
}

void LayerBoolean::clip_together(ClipperLib::ClipType type,
                                 std::span<const Loop> left,
                                 std::span<const Loop> right) {
  clipper_.Clear();
  for (const Loop& loop : left) {
    clipper_.AddPath(*loop.path, ClipperLib::ptSubject, true);
  }
  for (const Loop& loop : right) {
    clipper_.AddPath(*loop.path, ClipperLib::ptClip, true);
  }
  clipper_.Execute(type, solution_, ClipperLib::pftNonZero,
                   ClipperLib::pftNonZero);
  for (Path& path : solution_) {
    Path& kept = pool_.next();
    std::swap(kept, path);
    result_.add({&kept, box_of(kept)});
  }
}

}  // namespace lamina::rival
