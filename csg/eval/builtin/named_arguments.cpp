#include "csg/eval/builtin/named_arguments.h"

#include <cstdint>
#include <string>
#include <utility>

#include "csg/eval/code/argument_plan.h"
#include "csg/eval/run/interpreter.h"

namespace lamina::csg {

std::vector<Value> run_named_arguments(
    std::span<const std::string_view> parameters, std::size_t positional,
    const CallCode& code, Frame& frame) {
  std::vector<Parameter> targets;
  for (const std::string_view name : parameters) {
    const auto slot = static_cast<std::uint32_t>(targets.size());
    targets.emplace_back();
    targets.back().name = name;
    targets.back().target = {Target::Kind::kSlot, slot, nullptr};
  }
  const ArgumentPlan plan = plan_arguments(targets, positional, code.arguments,
                                           frame.in.dynamic_names());
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

}  // namespace lamina::csg
