#include "csg/boundary/program_region.h"

#include <functional>
#include <map>
#include <utility>

#include "plane/region/boolean.h"

namespace lamina::csg {
namespace {

using plane::Region;

// No value: the whole window.
using Value = std::optional<Region>;

bool is_empty(const Value& value) { return value && value->is_empty(); }

// An operator with live children. `count` covers only those that are not live
// (see ProgramState::count).
struct LiveNode {
  std::int32_t count = 0;
  std::optional<Value> minuend;  // of a difference, if it is live
  std::vector<Value> others;
};

Value unite(const LiveNode& node) {
  if (node.count > 0) return {};
  std::vector<Region> regions;
  for (const Value& value : node.others) {
    if (!value) return {};
    if (!value->is_empty()) regions.push_back(*value);
  }
  if (regions.empty()) return Region{};
  return plane::unite(regions);
}

Value intersect(const LiveNode& node, std::uint32_t child_count) {
  const auto live_count = static_cast<std::uint32_t>(node.others.size());
  if (static_cast<std::uint32_t>(node.count) + live_count < child_count) {
    return Region{};
  }
  std::vector<Region> regions;
  for (const Value& value : node.others) {
    if (value) regions.push_back(*value);
  }
  if (regions.empty()) return {};
  return plane::intersect(regions);
}

Value subtract(const LiveNode& node, const Region& window) {
  // A minuend that is not live must hold, and no such subtrahend may.
  const std::int32_t needed = node.minuend ? 0 : 1;
  if (node.count < needed) return Region{};
  Value minuend = node.minuend.value_or(Value{});
  if (is_empty(minuend)) return Region{};
  std::vector<Region> regions{minuend.value_or(window)};
  for (const Value& value : node.others) {
    if (!value) return Region{};
    if (!value->is_empty()) regions.push_back(*value);
  }
  if (regions.size() == 1) return minuend;
  return plane::subtract(regions);
}

class Evaluation {
 public:
  Evaluation(const Scene& scene, const plane::ProgramState& state,
             const Region& window)
      : scene_(scene), state_(state), window_(window) {}

  Value evaluate(const std::vector<LiveInstance>& live) {
    for (const LiveInstance& leaf : live) {
      const Instance& instance = scene_.instances[leaf.instance];
      for (std::uint32_t node = instance.parent;;) {
        const bool is_new =
            nodes_.try_emplace(node, LiveNode{state_.count(node), {}, {}})
                .second;
        if (!is_new || node == 0) break;
        node = scene_.program[node].parent;
      }
      add(instance.parent, instance.is_minuend, leaf.section);
    }
    // Children come after their parents.
    for (auto& [index, node] : nodes_) {
      const plane::BooleanNode& self = scene_.program[index];
      if (index == 0) return value_of(self, node);
      // What it counted for as if the live leaves were empty.
      LiveNode& parent = nodes_.at(self.parent);
      if (state_.value(index)) parent.count -= weight(self);
      add(self.parent, self.is_minuend, value_of(self, node));
    }
    return Value(state_.value() ? Value{} : Region{});
  }

 private:
  std::int32_t weight(const plane::BooleanNode& node) const {
    return plane::is_subtrahend(scene_.program, node) ? -1 : 1;
  }

  void add(std::uint32_t parent, bool is_minuend, Value value) {
    LiveNode& node = nodes_.at(parent);
    if (is_minuend &&
        scene_.program[parent].op == plane::BooleanOp::kDifference) {
      node.minuend = std::move(value);
    } else {
      node.others.push_back(std::move(value));
    }
  }

  Value value_of(const plane::BooleanNode& self, const LiveNode& node) const {
    switch (self.op) {
      case plane::BooleanOp::kUnion:
        return unite(node);
      case plane::BooleanOp::kIntersection:
        return intersect(node, self.child_count);
      case plane::BooleanOp::kDifference:
        break;
    }
    return subtract(node, window_);
  }

  const Scene& scene_;
  const plane::ProgramState& state_;
  const Region& window_;
  std::map<std::uint32_t, LiveNode, std::greater<>> nodes_;
};

}  // namespace

std::optional<Region> evaluate_in_window(const Scene& scene,
                                         const plane::ProgramState& state,
                                         const std::vector<LiveInstance>& live,
                                         const Region& window) {
  return Evaluation(scene, state, window).evaluate(live);
}

}  // namespace lamina::csg
