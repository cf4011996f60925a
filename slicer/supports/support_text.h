#pragma once
// Supports as lines of an OpenSCAD design that people can read and edit.

#include <array>
#include <string>
#include <string_view>

#include "slicer/supports/support_plan.h"

namespace lamina::slicer {

// A leaf that one of these modules of a design made is part of a support.
inline constexpr std::array<std::string_view, 3> kSupportModules = {
    "support_of", "support_brace", "support_raft"};

// design_from_job  from where the part stood to where the design has it
std::string support_text(const SupportPlan& plan,
                         const Affine& design_from_job);

}  // namespace lamina::slicer
