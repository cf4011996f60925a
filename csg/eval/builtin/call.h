#pragma once
// What built-in functions do with their arguments.

#include <cstddef>
#include <string>

#include "csg/eval/code/code.h"
#include "csg/eval/run/interpreter.h"

namespace lamina::csg {

inline Value argument(const CallCode& code, std::size_t i, Frame& frame) {
  return run(code.arguments[i].value, frame);
}

// Warnings; the result of the call is undef.
Value warn(const CallCode& code, Frame& frame, std::string message);
Value wrong_count(const CallCode& code, Frame& frame);
Value wrong_type(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
