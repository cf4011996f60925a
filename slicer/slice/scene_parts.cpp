#include "slicer/slice/scene_parts.h"

#include <algorithm>
#include <map>
#include <span>
#include <unordered_map>

#include "slicer/supports/support_text.h"

namespace lamina::slicer {

std::optional<csg::Scene> leaves_of(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_wanted) {
  csg::Scene part;
  part.program.emplace_back();
  std::unordered_map<std::uint32_t, std::uint32_t> leaf_numbers;
  for (const csg::Instance& instance : scene.instances) {
    if (!is_wanted(instance)) continue;
    const auto [number, is_new] = leaf_numbers.try_emplace(
        instance.leaf, static_cast<std::uint32_t>(part.leaves.size()));
    if (is_new) part.leaves.push_back(scene.leaves[instance.leaf]);
    csg::Instance& copy = part.instances.emplace_back(instance);
    copy.leaf = number->second;
    copy.parent = 0;
    copy.is_minuend = false;
    part.box.add(copy.box);
    ++part.program[0].child_count;
  }
  if (part.instances.empty()) return std::nullopt;
  return part;
}

bool is_made_by(const csg::Instance& instance,
                std::span<const std::string_view> modules) {
  const csg::CallSite* call = instance.caller;
  while (call != nullptr && std::ranges::count(modules, call->name) == 0) {
    call = call->caller;
  }
  return call != nullptr;
}

bool is_support(const csg::Scene& scene, const csg::Instance& instance) {
  if (!is_made_by(instance, kSupportModules)) return false;
  for (std::uint32_t node = instance.parent;;
       node = scene.program[node].parent) {
    if (scene.program[node].op != plane::BooleanOp::kUnion) return false;
    if (node == 0) return true;
  }
}

std::optional<csg::Scene> supports_of(const csg::Scene& scene) {
  return leaves_of(scene, [&](const csg::Instance& instance) {
    return is_support(scene, instance);
  });
}

csg::Scene without_supports(const csg::Scene& scene) {
  return without(scene, [&](const csg::Instance& instance) {
    return is_support(scene, instance);
  });
}

csg::Scene without(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_unwanted) {
  csg::Scene rest = scene;
  rest.instances.clear();
  for (const csg::Instance& instance : scene.instances) {
    if (is_unwanted(instance)) {
      --rest.program[instance.parent].child_count;
    } else {
      rest.instances.push_back(instance);
    }
  }
  rest.box = csg::bounds_of(rest);
  return rest;
}

namespace {

// What has one color: a leaf by itself, or all below an intersection that only
// unions and first operands of differences lead to.
constexpr std::uint32_t kNoOperator = 0xffffffff;
struct Unit {
  std::uint32_t intersection = kNoOperator;  // index into the program
  bool is_subtracted = false;                // by an operator above it
};

Unit unit_of(const csg::Scene& scene, const csg::Instance& instance) {
  const std::span<const plane::BooleanNode> nodes = scene.program;
  Unit unit;
  unit.is_subtracted = plane::is_subtrahend(nodes, instance);
  for (std::uint32_t node = instance.parent;; node = nodes[node].parent) {
    if (nodes[node].op == plane::BooleanOp::kIntersection) unit = {node, false};
    if (node == 0) return unit;
    if (plane::is_subtrahend(nodes, nodes[node])) unit = {kNoOperator, true};
  }
}

// The leaves of a scene by their colors.
class LeafColors {
 public:
  explicit LeafColors(const csg::Scene& scene) : scene_(scene) {
    units_.reserve(scene.instances.size());
    for (const csg::Instance& instance : scene.instances) {
      add(units_.emplace_back(unit_of(scene, instance)), instance.color);
    }
  }

  const std::vector<std::int32_t>& colors() const { return colors_; }

  csg::Scene part_of(std::int32_t color) const {
    csg::Scene part = scene_;
    part.instances.clear();
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const csg::Instance& instance = scene_.instances[i];
      if (units_[i].is_subtracted || color_of(i) == color) {
        part.instances.push_back(instance);
      } else {
        --part.program[instance.parent].child_count;
      }
    }
    clear_other_intersections(color, part.program);
    part.box = csg::bounds_of(part);
    return part;
  }

 private:
  void add(const Unit& unit, std::int32_t color) {
    if (unit.is_subtracted) return;
    if (unit.intersection != kNoOperator) {
      std::int32_t& known =
          by_intersection_.try_emplace(unit.intersection, csg::kNoColor)
              .first->second;
      if (known != csg::kNoColor) return;
      known = color;
    }
    if (color != csg::kNoColor && std::ranges::count(colors_, color) == 0) {
      colors_.push_back(color);
    }
  }

  std::int32_t color_of(std::size_t i) const {
    const Unit& unit = units_[i];
    return unit.intersection == kNoOperator
               ? scene_.instances[i].color
               : by_intersection_.at(unit.intersection);
  }

  // Intersections whose leaves were left out become unions of nothing.
  void clear_other_intersections(
      std::int32_t color, std::vector<plane::BooleanNode>& program) const {
    std::vector<bool> is_cleared(program.size());
    for (std::uint32_t node = 0; node < program.size(); ++node) {
      const auto found = by_intersection_.find(node);
      is_cleared[node] =
          (node > 0 && is_cleared[program[node].parent]) ||
          (found != by_intersection_.end() && found->second != color);
      if (is_cleared[node]) program[node].op = plane::BooleanOp::kUnion;
    }
  }

  const csg::Scene& scene_;
  std::vector<Unit> units_;  // as the scene's instances
  std::map<std::uint32_t, std::int32_t> by_intersection_;
  std::vector<std::int32_t> colors_;
};

}  // namespace

std::vector<ColoredScene> colored_parts_of(const csg::Scene& scene) {
  const LeafColors leaf_colors(scene);
  std::vector<ColoredScene> parts;
  for (const std::int32_t color : leaf_colors.colors()) {
    parts.push_back({color, leaf_colors.part_of(color)});
  }
  return parts;
}

}  // namespace lamina::slicer
