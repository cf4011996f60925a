#pragma once
// Parts of a scene by themselves: its supports, and what has a color.
//
// Supports are leaves that one of kSupportModules made and that nothing but
// unions has changed. What a difference or an intersection has in hand belongs
// to the part.

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "csg/scene.h"

namespace lamina::slicer {

// All leaves that are wanted, united, whatever the scene does with them. No
// value where there are none.
std::optional<csg::Scene> leaves_of(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_wanted);

// The scene without the leaves that are unwanted, each an operand of unions
// alone.
csg::Scene without(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_unwanted);

// Whether one of these modules of the design made the leaf.
bool is_made_by(const csg::Instance& instance,
                std::span<const std::string_view> modules);

bool is_support(const csg::Scene& scene, const csg::Instance& instance);

// No value where there are none.
std::optional<csg::Scene> supports_of(const csg::Scene& scene);

csg::Scene without_supports(const csg::Scene& scene);

struct ColoredScene {
  std::int32_t color = 0;  // 0xRRGGBB
  csg::Scene scene;
};

// One scene for each color, in the order in which leaves have them. Leaves
// without a color are in none but where they are subtracted or intersected.
std::vector<ColoredScene> colored_parts_of(const csg::Scene& scene);

}  // namespace lamina::slicer
