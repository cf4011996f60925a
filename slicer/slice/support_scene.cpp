#include "slicer/slice/support_scene.h"

#include <algorithm>
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

bool is_support(const csg::Scene& scene, const csg::Instance& instance) {
  bool is_made = false;
  for (const csg::CallSite* call = instance.caller; call != nullptr && !is_made;
       call = call->caller) {
    is_made = std::ranges::count(kSupportModules, call->name) > 0;
  }
  if (!is_made) return false;
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
  csg::Scene rest = scene;
  rest.instances.clear();
  rest.box = {};
  for (const csg::Instance& instance : scene.instances) {
    if (is_support(scene, instance)) {
      --rest.program[instance.parent].child_count;
    } else {
      rest.instances.push_back(instance);
      rest.box.add(instance.box);
    }
  }
  return rest;
}

}  // namespace lamina::slicer
