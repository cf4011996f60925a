#pragma once
// A part and its supports from the front, as an SVG drawing: small, and made in
// no time, for lists of many.

#include <span>
#include <string>

#include "slicer/contour/layer.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer {

// Of each layer it shows what the layer covers along x.
std::string front_svg(std::span<const Layer> layers, const SupportPlan& plan);

}  // namespace lamina::slicer
