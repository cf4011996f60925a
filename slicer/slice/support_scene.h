#pragma once
// Some leaves of a scene by themselves: the supports above all.

#include <functional>
#include <optional>

#include "csg/scene.h"

namespace lamina::slicer {

// All leaves that are wanted, united, whatever the scene does with them. No
// value where there are none.
std::optional<csg::Scene> leaves_of(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_wanted);

// The scene without the leaves that are not wanted. These must be operands of
// unions.
csg::Scene without_leaves(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_unwanted);

// Whether one of kSupportModules made the leaf.
bool is_support(const csg::Instance& instance);

}  // namespace lamina::slicer
