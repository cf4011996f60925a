// Running variables, conditions, ranges and let (see runners.h).

#include <cmath>

#include <fmt/format.h>

#include "csg/eval/run/interpreter.h"
#include "csg/eval/run/runners.h"
#include "csg/eval/value/operators.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

void warn(Frame& frame, SourceRange range, std::string message) {
  frame.in.warn(range, std::move(message), frame.document);
}

// --- Variables --------------------------------------------------------------

Value run_constant(const Expression& expression, Frame&) {
  return *as<Constant>(expression).value;
}

namespace {
// Loads a variable whose slot is unset or boxed.
[[gnu::noinline]] Value load_unusual(const VariableLoad& code,
                                     const Value& value, Frame& frame) {
  if (value.type() == Type::kBox && !value.as_box().value.is_unset()) {
    return value.as_box().value;
  }
  return run(code.otherwise, frame);
}
Value load(const VariableLoad& code, const Value& value, Frame& frame) {
  if (is_plain(value)) [[likely]]
    return value;
  return load_unusual(code, value, frame);
}
}  // namespace

Value run_local(const Expression& expression, Frame& frame) {
  return load(as<VariableLoad>(expression), frame.slots[expression.slot],
              frame);
}
Value run_outer(const Expression& expression, Frame& frame) {
  return load(as<VariableLoad>(expression), frame.link->slots[expression.slot],
              frame);
}
Value run_far_outer(const Expression& expression, Frame& frame) {
  const auto& code = as<VariableLoad>(expression);
  return load(code, follow_links(frame, code.hops)->slots[code.slot], frame);
}
Value run_captured(const Expression& expression, Frame& frame) {
  return load(as<VariableLoad>(expression),
              frame.closure->captured[expression.slot], frame);
}
Value run_dynamic(const Expression& expression, Frame& frame) {
  const auto& code = as<DynamicVariable>(expression);
  const Value& value = frame.in.dynamic(code.index);
  if (!value.is_unset()) return value;
  if (!code.is_silent) {
    frame.in.warn_of_unknown(Named::kVariable, code.range, code.name,
                             frame.document);
  }
  return Value();
}
Value run_inexact_literal(const Expression& expression, Frame& frame) {
  const auto& code = as<InexactLiteral>(expression);
  warn(frame, code.range, std::string(code.warning));
  return Value(code.value);
}
Value run_unknown_variable(const Expression& expression, Frame& frame) {
  frame.in.warn_of_unknown(Named::kVariable, expression.range,
                           as<UnknownVariable>(expression).name);
  return Value();
}

// --- Conditions, elements, ranges -------------------------------------------

Value run_conditional(const Expression& expression, Frame& frame) {
  const auto& code = as<ConditionalCode>(expression);
  return run(is_true(code.condition, frame) ? code.if_true : code.if_false,
             frame);
}

namespace {
// Like `look`, for an element of a vector.
const Value& look_at_element(const BinaryCode& code, Frame& frame,
                             Value& spill) {
  Value spill_object;
  Value spill_index;
  const Value& i = look(code.right, frame, spill_index);
  const Value& object = look(code.left, frame, spill_object);
  if (object.is_vector() && &object != &spill_object && i.is_number()) {
    const std::span<const Value> elements = object.as_vector();
    const double number = i.as_number();
    // Cut towards zero, as index() does.
    if (number >= 0 && number < static_cast<double>(elements.size())) {
      return elements[static_cast<std::uint32_t>(number)];
    }
  }
  spill = index(object, i);
  return spill;
}
}  // namespace

Value run_index(const Expression& expression, Frame& frame) {
  Value spill;
  const Value& element =
      look_at_element(as<BinaryCode>(expression), frame, spill);
  if (&element == &spill) return spill;
  return element;
}

const Value& look_further(const Expression* code, Frame& frame, Value& spill) {
  if (code->kind == Expression::Kind::kOuter &&
      is_plain(frame.link->slots[code->slot])) {
    return frame.link->slots[code->slot];
  }
  if (code->kind == Expression::Kind::kIndex) {
    return look_at_element(as<BinaryCode>(*code), frame, spill);
  }
  spill = run(code, frame);
  return spill;
}

Value run_member(const Expression& expression, Frame& frame) {
  const auto& code = as<MemberCode>(expression);
  Value spill;
  const Value& object = look(code.object, frame, spill);
  if (object.is_vector() && code.name.size() > 1) {
    const Value found = member(object, code.name);
    if (found.is_vector()) frame.in.note_newer(code.range, "several members");
    return found;
  }
  return member(object, code.name);
}

namespace {
// Only numbers in the text count: a range of other values may well be empty.
void warn_of_direction(const RangeCode& code, std::string_view begin,
                       std::string_view step, Frame& frame) {
  if (!code.is_literal) return;
  warn(frame, code.range,
       fmt::format("begin is {} than the end, but step is {}", begin, step));
}
}  // namespace

Value run_range(const Expression& expression, Frame& frame) {
  const auto& code = as<RangeCode>(expression);
  const bool is_2021 = frame.in.is_2021();
  const Value first = run(code.begin, frame);
  if (!first.is_number() && is_2021) return Value();
  const Value last = run(code.end, frame);
  if (!first.is_number() || !last.is_number()) {
    if (!is_2021) {
      frame.in.warn(code.range,
                    fmt::format("Unable to convert [{}:...:{}] to a range",
                                to_echo(first), to_echo(last)));
    }
    return Value();
  }
  const double begin = first.as_number();
  const double end = last.as_number();
  if (code.step == nullptr) {
    if (end >= begin || std::isnan(begin) || std::isnan(end)) {
      return Value::range(begin, 1, end);
    }
    if (!is_2021) {
      warn_of_direction(code, "greater", "positive", frame);
      return Value::range(begin, 1, end);
    }
    frame.in.deprecate(code.range,
                       "Using ranges of the form [begin:end] with begin value "
                       "greater than the end value is deprecated",
                       frame.document);
    return Value::range(end, 1, begin);
  }
  const Value step = run(code.step, frame);
  if (!step.is_number()) {
    if (!is_2021) {
      frame.in.warn(
          code.range,
          fmt::format("Unable to convert [...:{}:...] to a step value",
                      to_echo(step)));
    }
    return Value();
  }
  if (step.as_number() > 0 && end < begin) {
    warn_of_direction(code, "greater", "positive", frame);
  } else if (step.as_number() < 0 && end > begin) {
    warn_of_direction(code, "smaller", "negative", frame);
  }
  return Value::range(begin, step.as_number(), end);
}

// --- let, echo, assert ------------------------------------------------------

void run_bindings(Bindings bindings, Frame& frame) {
  for (const Binding& binding : bindings) prepare(binding.target, frame);
  for (const Binding& binding : bindings) {
    Value value = run(binding.value, frame);
    if (binding.target.kind != Target::Kind::kNowhere) [[likely]] {
      frame.in.assign(binding.target, std::move(value), frame);
    } else if (binding.name.empty()) {
      warn(frame, binding.range,
           "Assignment without variable name " + to_echo(value));
    } else {
      warn(frame, binding.range,
           fmt::format("Ignoring duplicate variable assignment {} = {}",
                       quoted_name(binding.name, frame.in.language(), ""),
                       to_echo(value)));
    }
  }
}

Value run_let(const Expression& expression, Frame& frame) {
  const auto& code = as<LetCode>(expression);
  const DynamicScope scope(frame.in);
  run_bindings(code.bindings, frame);
  return run(code.body, frame);
}

std::string echo_text(std::span<const WrittenArgument> arguments,
                      Frame& frame) {
  std::string text;
  for (const WrittenArgument& argument : arguments) {
    if (&argument != arguments.data()) text += ", ";
    if (!argument.name.empty()) {
      text += argument.name;
      text += " = ";
    }
    append_echo(run(argument.value, frame), text);
  }
  return text;
}

Value run_echo(const Expression& expression, Frame& frame) {
  const auto& code = as<EchoCode>(expression);
  frame.in.echo(echo_text(code.arguments, frame));
  return code.body != nullptr ? run(code.body, frame) : Value();
}

void run_assert(const AssertCode& code, Frame& frame) {
  frame.in.warn_of_arguments(*code.plan, code.range, frame.document);
  const Value condition = run(code.condition, frame);
  const Value message = run(code.message, frame);
  if (condition.is_true()) return;
  Diagnostic diagnostic{
      .range = code.range, .message = "Assertion", .document = frame.document};
  if (code.condition_text != nullptr) {
    const std::string text = expression_text(*code.condition_text);
    diagnostic.message += " '" + text + "'";
    if (frame.in.is_2021() && text.find("version") != std::string::npos) {
      frame.in.note_newer(code.range, "assert() of a newer version");
      diagnostic.hints.push_back(
          {{},
           "read as OpenSCAD 2021.01; --language 2026 reads it as newer ones"});
    }
  }
  diagnostic.message += " failed";
  if (!message.is_undef()) diagnostic.message += ": " + to_echo(message);
  frame.in.fail(std::move(diagnostic));
}

Value run_assert_expression(const Expression& expression, Frame& frame) {
  const auto& code = as<AssertCode>(expression);
  run_assert(code, frame);
  return code.body != nullptr ? run(code.body, frame) : Value();
}

}  // namespace lamina::csg
