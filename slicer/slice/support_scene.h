#pragma once
// Some leaves of a scene by themselves: its supports above all.
//
// Supports are leaves that one of kSupportModules made and that nothing but
// unions has changed. What a difference or an intersection has in hand belongs
// to the part.

#include <functional>
#include <optional>

#include "csg/scene.h"

namespace lamina::slicer {

// All leaves that are wanted, united, whatever the scene does with them. No
// value where there are none.
std::optional<csg::Scene> leaves_of(
    const csg::Scene& scene,
    const std::function<bool(const csg::Instance&)>& is_wanted);

bool is_support(const csg::Scene& scene, const csg::Instance& instance);

// No value where there are none.
std::optional<csg::Scene> supports_of(const csg::Scene& scene);

csg::Scene without_supports(const csg::Scene& scene);

}  // namespace lamina::slicer
