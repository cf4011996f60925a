#include "csg/eval/builtin/call.h"

#include "csg/eval/code/argument_plan.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

std::vector<Value> run_named_arguments(
    std::span<const std::string_view> parameters, std::size_t positional,
    const CallCode& code, Frame& frame) {
  const ArgumentPlan plan =
      plan_arguments(make_parameters(parameters), positional, code.arguments,
                     frame.in.dynamic_names(), frame.in.language());
  frame.in.warn_of_arguments(plan, code.range, frame.document);
  std::vector<Value> values(parameters.size());
  for (const BoundArgument& bound : plan.bound) {
    Value value = run(code.arguments[bound.written].value, frame);
    if (bound.target.kind == Target::Kind::kSlot) {
      values[bound.target.index] = std::move(value);
    }
  }
  return values;
}

namespace {
void run_from(const CallCode& code, std::size_t first, Frame& frame) {
  for (std::size_t i = first; i < code.arguments.size(); ++i) {
    run(code.arguments[i].value, frame);
  }
}
}  // namespace

Value wrong_count(const CallCode& code, Frame& frame,
                  std::string_view expected) {
  if (frame.in.is_2021()) {
    return warn(code, frame, "{}() number of parameters does not match",
                code.name);
  }
  return wrong_count_of_new(code, frame, expected);
}

Value wrong_count_of_new(const CallCode& code, Frame& frame,
                         std::string_view expected) {
  // The arguments are evaluated before they are counted.
  run_from(code, 0, frame);
  return warn_in_file(
      code, frame,
      "{}() number of parameters does not match: expected {}, found {}",
      code.name, expected, code.arguments.size());
}

Value wrong_type(const CallCode& code, Frame& frame, std::size_t argument,
                 Type expected, const Value& found) {
  if (frame.in.is_2021()) {
    return warn(code, frame, "{}() parameter could not be converted",
                code.name);
  }
  return wrong_type_of_new(code, frame, argument, expected, found);
}

void run_rest(const CallCode& code, std::size_t next, Frame& frame) {
  if (!frame.in.is_2021()) run_from(code, next, frame);
}

Value newly_wrong_type(const CallCode& code, Frame& frame, std::size_t argument,
                       Type expected, const Value& found) {
  if (frame.in.is_2021()) return Value();
  return wrong_type_of_new(code, frame, argument, expected, found);
}

Value wrong_type_of_new(const CallCode& code, Frame& frame,
                        std::size_t argument, Type expected,
                        const Value& found) {
  return warn_in_file(
      code, frame,
      "{}() parameter could not be converted: argument {}: expected "
      "{}, found {} ({})",
      code.name, argument, type_name(expected), type_name(found.type()),
      to_echo(found));
}

}  // namespace lamina::csg
