#pragma once
// Sprues as lines of an OpenSCAD design that people can read and edit.

#include <string>
#include <string_view>

#include "slicer/casting/sprue_plan.h"

namespace lamina::slicer {

// The module of the written design that has all sprues.
inline constexpr std::string_view kSpruesModule = "lamina_sprues";

// plan  of the design as it stands
std::string sprue_text(const SpruePlan& plan);

}  // namespace lamina::slicer
