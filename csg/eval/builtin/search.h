#pragma once
// search(): where values stand in a string, a list or the column of a table.

#include "csg/eval/code/code.h"

namespace lamina::csg {

Value builtin_search(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
