#pragma once
// The built-in functions about objects, which are newer than OpenSCAD 2021.01.

#include "csg/eval/code/code.h"

namespace lamina::csg {

// object(…) makes an object member by member. `name = value` sets one, an
// object sets all of its own, a list of [name, value] and [name] sets and
// removes.
Value builtin_object(const CallCode& code, Frame& frame);
Value builtin_has_key(const CallCode& code, Frame& frame);
Value builtin_is_object(const CallCode& code, Frame& frame);

// import(file): what a JSON file holds.
Value builtin_import(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
