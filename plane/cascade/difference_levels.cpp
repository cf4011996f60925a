#include "plane/cascade/difference_levels.h"

namespace lamina::plane {
namespace {

constexpr std::uint32_t kNoDifference = 0xffffffff;

// Of each node: the difference below it with the most levels, or kNoDifference.
std::vector<std::uint32_t> find_next_levels(const BooleanProgram& program) {
  const std::vector<BooleanNode>& nodes = program.nodes;
  std::vector<std::uint32_t> levels(nodes.size(), 1);
  std::vector<std::uint32_t> next(nodes.size(), kNoDifference);
  // Children come after their parents.
  for (std::size_t i = nodes.size(); i-- > 1;) {
    const BooleanNode& node = nodes[i];
    if (node.op != BooleanOp::kDifference) continue;
    if (!is_subtrahend<BooleanNode>(nodes, node)) continue;
    if (levels[i] < levels[node.parent]) continue;
    levels[node.parent] = levels[i] + 1;
    next[node.parent] = static_cast<std::uint32_t>(i);
  }
  return next;
}

}  // namespace

DifferenceLevels difference_levels(const BooleanProgram& program) {
  constexpr std::uint32_t kRoot = 0;
  DifferenceLevels levels;
  if (program.nodes[kRoot].op != BooleanOp::kDifference) return levels;
  const std::vector<std::uint32_t> next = find_next_levels(program);
  // Of each node: its level, and its number there.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> nodes(
      program.nodes.size());
  std::uint32_t root = kRoot;  // of the lowest level so far
  for (std::uint32_t i = 0; i < program.nodes.size(); ++i) {
    BooleanNode node = program.nodes[i];
    if (i == root) {
      nodes[i] = {static_cast<std::uint32_t>(levels.programs.size()), kRoot};
      const std::uint32_t count =
          node.child_count - (next[i] == kNoDifference ? 0U : 1U);
      levels.programs.push_back({{{node.op, kRoot, false, count}}, {}});
      root = next[i];
      continue;
    }
    const auto [level, parent] = nodes[node.parent];
    BooleanProgram& of_level = levels.programs[level];
    nodes[i] = {level, static_cast<std::uint32_t>(of_level.nodes.size())};
    node.parent = parent;
    of_level.nodes.push_back(node);
  }
  for (Operand operand : program.operands) {
    const auto [level, parent] = nodes[operand.parent];
    BooleanProgram& of_level = levels.programs[level];
    levels.places.emplace_back(
        level, static_cast<std::uint32_t>(of_level.operands.size()));
    operand.parent = parent;
    of_level.operands.push_back(operand);
  }
  return levels;
}

}  // namespace lamina::plane
