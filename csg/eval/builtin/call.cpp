#include "csg/eval/builtin/call.h"

#include "csg/eval/code/argument_plan.h"

namespace lamina::csg {

std::vector<Value> run_named_arguments(
    std::span<const std::string_view> parameters, std::size_t positional,
    const CallCode& code, Frame& frame) {
  const ArgumentPlan plan =
      plan_arguments(make_parameters(parameters), positional, code.arguments,
                     frame.in.dynamic_names(), frame.in.language());
  for (const std::string& warning : plan.warnings) {
    frame.in.warn(code.range, warning, frame.document);
  }
  std::vector<Value> values(parameters.size());
  for (const BoundArgument& bound : plan.bound) {
    Value value = run(code.arguments[bound.written].value, frame);
    if (bound.target.kind == Target::Kind::kSlot) {
      values[bound.target.index] = std::move(value);
    }
  }
  return values;
}

Value wrong_count(const CallCode& code, Frame& frame) {
  return warn(code, frame, "{}() number of parameters does not match",
              code.name);
}
Value wrong_type(const CallCode& code, Frame& frame) {
  return warn(code, frame, "{}() parameter could not be converted", code.name);
}

}  // namespace lamina::csg
