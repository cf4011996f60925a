#pragma once
// What built-in functions have in common: reading arguments, warning of them.

#include <cstddef>
#include <string>

#include "csg/eval/code/code.h"
#include "csg/eval/run/interpreter.h"

namespace lamina::csg {

inline Value argument(const CallCode& code, std::size_t i, Frame& frame) {
  return run(code.arguments[i].value, frame);
}

// Warn and return undef, the result of the call.
Value warn(const CallCode& code, Frame& frame, std::string message);
Value wrong_count(const CallCode& code, Frame& frame);
Value wrong_type(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
