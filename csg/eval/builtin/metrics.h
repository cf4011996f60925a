#pragma once
// textmetrics() and fontmetrics(), which are newer than OpenSCAD 2021.01.

#include "csg/eval/code/code.h"

namespace lamina::csg {

// Both return an object; undef where there is no font.
Value builtin_textmetrics(const CallCode& code, Frame& frame);
Value builtin_fontmetrics(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
