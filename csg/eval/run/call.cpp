// Running function literals, calls and bodies (see runners.h).

#include <memory>
#include <vector>

#include <fmt/format.h>

#include "csg/eval/run/arguments.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/run/runners.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

// --- Functions --------------------------------------------------------------

Value run_function_literal(const Expression& expression, Frame& frame) {
  const FunctionLiteral& literal = *as<LiteralCode>(expression).literal;
  auto* closure = new Closure;
  closure->code = &literal;
  closure->link = literal.hops == 0 ? &frame : frame.link;
  closure->captured.reserve(literal.captures.size());
  for (const FunctionLiteral::Capture& capture : literal.captures) {
    closure->captured.push_back(capture.from_closure
                                    ? frame.closure->captured[capture.index]
                                    : frame.slots[capture.index]);
  }
  return Value::adopt(Type::kFunction, closure, 0);
}

namespace {

[[gnu::noinline]] void give_warnings(const ArgumentPlan& plan,
                                     SourceRange range, Frame& caller,
                                     Repeats repeats) {
  if (repeats == Repeats::kSilent && !caller.in.is_first_of_call(range)) return;
  caller.in.warn_of_arguments(plan, range, caller.document);
}
void warn_of_arguments(const ArgumentPlan& plan, SourceRange range,
                       Frame& caller, Repeats repeats) {
  if (!plan.warnings.empty()) give_warnings(plan, range, caller, repeats);
}

}  // namespace

namespace {

[[gnu::always_inline]] inline void set_fallbacks(
    const ArgumentPlan& plan, std::span<const Parameter> parameters,
    Frame& callee) {
  for (const std::uint32_t i : plan.defaults) {
    const Parameter& parameter = parameters[i];
    Value value =
        parameter.fallback ? run(parameter.fallback, callee) : Value();
    callee.in.assign(parameter.target, std::move(value), callee);
  }
}

}  // namespace

void pass_arguments(const ArgumentPlan& plan,
                    std::span<const Parameter> parameters,
                    std::span<const WrittenArgument> arguments,
                    SourceRange range, Frame& caller, Frame& callee,
                    Repeats repeats) {
  const auto set = [&](const Target& target, Value&& value) {
    callee.in.assign(target, std::move(value), callee);
  };
  if (!plan.evaluates_fallbacks_last) {
    set_fallbacks(plan, parameters, callee);
    warn_of_arguments(plan, range, caller, repeats);
    for (const BoundArgument& bound : plan.bound) {
      set(bound.target, run(arguments[bound.written].value, caller));
    }
    return;
  }
  DynamicValues values = run_arguments(plan, arguments, caller, set);
  warn_of_arguments(plan, range, caller, repeats);
  set_fallbacks(plan, parameters, callee);
  bind(std::move(values), callee.in);
}

// --- Entering functions -----------------------------------------------------

namespace {

// Makes `callee`, which has its slots, the frame of the function that a call
// names.
[[gnu::always_inline]] inline void enter_function(const CallCode& code,
                                                  Frame& frame, Frame& callee) {
  const Function& function = *code.function;
  callee.document = function.unit->document;
  callee.link = code.is_foreign ? &frame.in.enter_unit(*function.unit)
                                : follow_links(frame, code.hops);
  pass_arguments(*code.plan, function.parameters, code.arguments, code.range,
                 frame, callee,
                 code.is_self_call ? Repeats::kSilent : Repeats::kReported);
}

// Sets the parameter `this` of a method to its object, whatever was passed for
// it.
[[gnu::noinline]] void pass_this(const Closure& closure, Frame& callee) {
  for (const Parameter& parameter : literal_of(closure).parameters) {
    if (parameter.name != "this") continue;
    callee.in.assign(parameter.target, Value(closure.method->object), callee);
  }
}

// Makes `callee` the frame of a function value.
[[gnu::always_inline]] inline void enter_closure(const CallCode& code,
                                                 const LiteralCall& planned,
                                                 const Closure& closure,
                                                 Frame& frame, Frame& callee) {
  callee.link = closure.link;
  callee.closure = &closure;
  callee.document = planned.literal->document;
  const bool is_self_call =
      code.kind == Expression::Kind::kTailCall && frame.closure == &closure;
  pass_arguments(planned.plan, planned.literal->parameters, code.arguments,
                 code.range, frame, callee,
                 is_self_call ? Repeats::kSilent : Repeats::kReported);
  if (closure.method != nullptr) [[unlikely]]
    pass_this(closure, callee);
}

}  // namespace

// --- Tail calls -------------------------------------------------------------

namespace {

// Overwrites the frame with the arguments of a tail call. `$` variables that
// the arguments and enclosing lets bind stay bound.
void jump(const CallCode& call, const ArgumentPlan& plan,
          std::span<const BoundArgument> bound, std::size_t trail_mark,
          Frame& frame) {
  warn_of_arguments(plan, call.range, frame, Repeats::kSilent);
  const auto count = static_cast<std::uint32_t>(bound.size());
  Frame scratch{frame.in};
  Value* memory = LAMINA_FRAME_MEMORY(count);
  const FrameSlots values(scratch, memory, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    memory[i] = run(call.arguments[bound[i].written].value, frame);
  }
  const auto store = [&](const Target& target, Value value) {
    if (target.kind == Target::Kind::kDynamic) {
      frame.in.rebind_dynamic(target.index, std::move(value), trail_mark);
    } else {
      frame.in.assign(target, std::move(value), frame);
    }
  };
  for (const CallCode::TailDefault& fallback : call.tail_defaults) {
    if (!fallback.is_evaluated_once) {
      store(fallback.target, run(fallback.value, frame));
      continue;
    }
    if (frame.in.tail_value(fallback.number).is_unset()) {
      frame.in.set_tail_value(fallback.number, run(fallback.value, frame));
    }
    store(fallback.target, frame.in.tail_value(fallback.number));
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    store(bound[i].target, std::move(memory[i]));
  }
}

// Jumps if a tail call names the function literal by which this call got here,
// and the name still means that literal.
bool jump_to_literal(const CallCode& call, const Callable& callable,
                     std::string_view name, std::size_t trail_mark,
                     Frame& frame) {
  if (call.callee == nullptr || call.name != name) return false;
  if (frame.closure == nullptr || frame.closure->method != nullptr) {
    return false;
  }
  const Value callee = run(call.callee, frame);
  if (!callee.is_function() || &callee.as_function() != frame.closure) {
    return false;
  }
  const auto& here = static_cast<const FunctionLiteral&>(callable);
  const auto& [literal, plan] = frame.in.plan_for(call, here);
  if (literal != &here || !plan.defaults.empty()) return false;
  jump(call, plan, plan.bound, trail_mark, frame);
  return true;
}

// A call of another function in tail position, left to the loop in run_body().
struct DeferredCall {
  explicit DeferredCall(Interpreter& in) : frame{in} {}

  const Callable* callable = nullptr;
  std::string_view name;  // by which it is called
  Frame frame;
  std::vector<Value> slots;
  Value function;  // keeps a function value alive
};

// Calls nested deeper than this are deferred where they can be: it takes
// longer, but no stack.
constexpr std::uint32_t kDeepCalls = 10000;

// Null where the call names nothing that OpenSCAD's language could run.
[[gnu::noinline]] std::unique_ptr<DeferredCall> defer(const CallCode& call,
                                                      Frame& frame) {
  auto deferred = std::make_unique<DeferredCall>(frame.in);
  const auto make_slots = [&](const Callable& callable) {
    deferred->callable = &callable;
    deferred->name = call.name;
    deferred->slots.assign(callable.slot_count, Value::unset());
    deferred->frame.slots = deferred->slots.data();
  };
  if (call.callee != nullptr) deferred->function = run(call.callee, frame);
  if (deferred->function.is_function()) {
    const Closure& closure = deferred->function.as_function();
    const LiteralCall& planned = frame.in.plan_for(call, literal_of(closure));
    make_slots(*planned.literal);
    enter_closure(call, planned, closure, frame, deferred->frame);
    return deferred;
  }
  if (call.function == nullptr) return nullptr;
  frame.in.ensure_resolved(*call.function);
  make_slots(*call.function);
  enter_function(call, frame, deferred->frame);
  return deferred;
}

enum class Round : std::uint8_t { kDone, kAgain, kDeferred };

// Follows the tail positions of a body, to its result or to the next call.
Round run_round(const Callable& callable, std::string_view name,
                std::size_t trail_mark, Frame& frame, Value& result,
                std::unique_ptr<DeferredCall>& deferred) {
  const Expression* code = callable.body;
  while (true) {
    switch (code->kind) {
      case Expression::Kind::kConditional: {
        const auto& conditional = as<ConditionalCode>(*code);
        code = is_true(conditional.condition, frame) ? conditional.if_true
                                                     : conditional.if_false;
        break;
      }
      case Expression::Kind::kLet:
        run_bindings(as<LetCode>(*code).bindings, frame);
        code = as<LetCode>(*code).body;
        break;
      case Expression::Kind::kAssert:
        run_assert(as<AssertCode>(*code), frame);
        code = as<AssertCode>(*code).body;
        break;
      case Expression::Kind::kEcho:
        frame.in.echo(echo_text(as<EchoCode>(*code).arguments, frame));
        code = as<EchoCode>(*code).body;
        break;
      case Expression::Kind::kTailCall: {
        const auto& call = as<CallCode>(*code);
        if (call.is_jump) {
          jump(call, *call.plan, call.tail_arguments, trail_mark, frame);
          return Round::kAgain;
        }
        if (jump_to_literal(call, callable, name, trail_mark, frame)) {
          return Round::kAgain;
        }
        if (call.may_be_deferred && frame.in.depth() > kDeepCalls) {
          // `deferred` may hold the frame that runs.
          auto next = defer(call, frame);
          if (next != nullptr) {
            deferred = std::move(next);
            return Round::kDeferred;
          }
        }
        result = run(code, frame);
        return Round::kDone;
      }
      default:
        result = run(code, frame);
        return Round::kDone;
    }
    if (code == nullptr) {
      result = Value();
      return Round::kDone;
    }
  }
}

}  // namespace

Value run_body(const Callable& callable, std::string_view name,
               SourceRange range, Frame& frame) {
  if (!callable.has_tail_calls) return run(callable.body, frame);
  constexpr std::uint32_t kMostTailCalls = 1000000;
  const std::size_t trail_mark = frame.in.trail_size();
  Value result;
  std::unique_ptr<DeferredCall> deferred;
  const Callable* current = &callable;
  std::string_view current_name = name;
  Frame* current_frame = &frame;
  for (std::uint32_t rounds = 0;; ++rounds) {
    switch (run_round(*current, current_name, trail_mark, *current_frame,
                      result, deferred)) {
      case Round::kDone:
        return result;
      case Round::kAgain:
        break;
      case Round::kDeferred:
        current = deferred->callable;
        current_name = deferred->name;
        current_frame = &deferred->frame;
        break;
    }
    frame.in.count_step();
    if (rounds == kMostTailCalls) {
      frame.in.fail_recursion(range, "function", name, frame.document);
    }
  }
}

// --- Calls ------------------------------------------------------------------

// Made only when a message needs it: in f(1)(2)(3)… each callee holds all
// before it.
std::string shown_name(const CallCode& code) {
  return code.callee_text == nullptr
             ? std::string(code.name)
             : fmt::format("({})", expression_text(*code.callee_text));
}

namespace {

Value call_function(const CallCode& code, Frame& frame) {
  const Function& function = *code.function;
  frame.in.ensure_resolved(function);
  const DynamicScope scope(frame.in);
  Frame callee{frame.in};
  Value* memory = LAMINA_FRAME_MEMORY(function.slot_count);
  const FrameSlots slots(callee, memory, function.slot_count);
  enter_function(code, frame, callee);
  return run_body(function, function.name, function.range, callee);
}

// Calls a function value, which `function` keeps alive.
Value call_closure(const CallCode& code, const Value& function, Frame& frame) {
  const Closure& closure = function.as_function();
  const LiteralCall& planned = frame.in.plan_for(code, literal_of(closure));
  const Callable& callable = *planned.literal;
  const DynamicScope scope(frame.in);
  Frame callee{frame.in};
  Value* memory = LAMINA_FRAME_MEMORY(callable.slot_count);
  const FrameSlots slots(callee, memory, callable.slot_count);
  enter_closure(code, planned, closure, frame, callee);
  return run_body(callable, code.name, code.range, callee);
}

Value report_unknown(const CallCode& code, Frame& frame) {
  frame.in.warn_of_unknown(Named::kFunction, code.range, code.name);
  return Value();
}

}  // namespace

Value run_call_function(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  frame.in.check_depth(code.range, "function", code.name, frame.document);
  const ActiveCall active(code, frame);
  return call_function(code, frame);
}

Value run_call_math(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  const ActiveCall active(code, frame);
  return code.builtin(code, frame);
}

Value run_call_builtin(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  frame.in.check_depth(code.range, "function", code.name, frame.document);
  const ActiveCall active(code, frame);
  return code.builtin(code, frame);
}

Value run_call_unknown(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  const ActiveCall active(code, frame);
  return report_unknown(code, frame);
}

Value run_call_value(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  if (frame.in.is_too_deep()) {
    frame.in.fail_recursion(code.range, "function", shown_name(code),
                            frame.document);
  }
  const ActiveCall active(code, frame);
  const Value callee = run(code.callee, frame);
  if (callee.is_function()) {
    if (code.is_name && code.name[0] == '$' && frame.in.is_2021()) {
      frame.in.note_newer(code.range, "call of a function in a $ variable");
      warn(frame, code.range,
           "Can't call function on dynamically scoped variable");
      return Value();
    }
    return call_closure(code, callee, frame);
  }
  if (!code.is_name) {
    warn(frame, code.range,
         fmt::format("Can't call function on {}", type_name(callee.type())));
    return Value();
  }
  if (code.function != nullptr) return call_function(code, frame);
  if (code.builtin != nullptr) return code.builtin(code, frame);
  return report_unknown(code, frame);
}

}  // namespace lamina::csg
