#pragma once
// dxf_dim() and dxf_cross(): lengths and points out of drawings.

#include "csg/eval/code/code.h"

namespace lamina::csg {

// The value of a dimension, found by its name and layer.
Value builtin_dxf_dim(const CallCode& code, Frame& frame);

// Where the first two lines of a layer that touch no other line would meet.
Value builtin_dxf_cross(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
