#include "csg/eval/builtin/call.h"

#include <fmt/format.h>

namespace lamina::csg {

Value warn(const CallCode& code, Frame& frame, std::string message) {
  frame.in.warn(code.range, std::move(message));
  return Value();
}
Value wrong_count(const CallCode& code, Frame& frame) {
  return warn(
      code, frame,
      fmt::format("{}() number of parameters does not match", code.name));
}
Value wrong_type(const CallCode& code, Frame& frame) {
  return warn(code, frame,
              fmt::format("{}() parameter could not be converted", code.name));
}

}  // namespace lamina::csg
