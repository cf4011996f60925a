#pragma once
// Supports as lines of an OpenSCAD design that people can read and edit.

#include <string>

#include "slicer/supports/support_plan.h"

namespace lamina::slicer {

// design_from_job  from where the part stood to where the design has it
std::string support_text(const SupportPlan& plan,
                         const Affine& design_from_job);

}  // namespace lamina::slicer
