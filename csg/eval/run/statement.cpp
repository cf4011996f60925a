// Running instantiations (see runners.h).

#include <vector>

#include <fmt/format.h>

#include "csg/eval/run/each_value.h"
#include "csg/eval/run/runners.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

template <typename T>
const T& as(const InstantiationCode& instantiation) {
  return static_cast<const T&>(instantiation);
}

void unset(std::span<const std::uint32_t> slots, Frame& frame) {
  for (const std::uint32_t slot : slots) frame.slots[slot] = Value::unset();
}

}  // namespace

// --- Blocks -----------------------------------------------------------------

void run_assignments(const Block& block, Frame& frame) {
  unset(block.resets, frame);
  for (const Binding& binding : block.assignments) {
    frame.in.assign(binding.target, run(binding.value, frame), frame);
  }
}

void run_statements(const Block& block, Frame& frame) {
  for (const InstantiationCode* code : block.statements) {
    instantiate(*code, frame);
  }
}

void run_block(const Block& block, Frame& frame) {
  run_assignments(block, frame);
  run_statements(block, frame);
}

void instantiate(const InstantiationCode& code, Frame& frame) {
  const ActiveCall active(code, frame);
  const DynamicScope scope(frame.in);
  code.run(code, frame);
}

// --- Modules of the user ----------------------------------------------------

namespace {

// Keeps the call chain, and the names that parent_module() shows, during one
// call.
class ModuleCall {
 public:
  ModuleCall(const UserModuleCode& code, Interpreter& in)
      : in_(in), outer_(in.current_call) {
    CallSite call;
    call.caller = outer_;
    call.name = code.name;
    call.range = code.range;
    in.module_names.push_back(code.name);
    in.current_call = in.keep_call(call);
  }
  ~ModuleCall() {
    in_.module_names.pop_back();
    in_.current_call = outer_;
  }
  ModuleCall(const ModuleCall&) = delete;
  ModuleCall& operator=(const ModuleCall&) = delete;

 private:
  Interpreter& in_;
  const CallSite* outer_;
};

void run_module_body(const Module& module, Frame& frame) {
  auto overwrite = module.overwrites.begin();
  for (std::uint32_t i = 0; i < module.body.assignments.size(); ++i) {
    const Binding& binding = module.body.assignments[i];
    if (overwrite != module.overwrites.end() && overwrite->first == i) {
      frame.in.warn(binding.range, overwrite->second, frame.document);
      ++overwrite;
    }
    frame.in.assign(binding.target, run(binding.value, frame), frame);
  }
  run_statements(module.body, frame);
}

}  // namespace

void run_user_module(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<UserModuleCode>(instantiation);
  Interpreter& in = frame.in;
  const Module& module = *code.module;
  in.check_depth(module.range, "module", code.name, module.unit->document);
  in.ensure_resolved(module);
  const std::size_t mark = in.node_mark();
  // Arguments may use these.
  if (code.block->assigns_before_call) run_assignments(*code.block, frame);
  Frame callee{in};
  callee.link = code.is_foreign ? &in.enter_unit(*module.unit)
                                : follow_links(frame, code.hops);
  callee.document = module.unit->document;
  callee.children = code.block;
  callee.children_frame = &frame;
  Value* memory = LAMINA_FRAME_MEMORY(module.slot_count);
  const FrameSlots slots(callee, memory, module.slot_count);
  callee.slots[Module::kChildrenSlot] =
      Value(static_cast<double>(code.block->statements.size()));
  {
    const ModuleCall call(code, in);
    // In 2021 arguments see `$parent_modules` of the call, in 2026 that of the
    // caller.
    if (in.is_2021()) in.bind_module_depth();
    pass_arguments(*code.plan, module.parameters, code.arguments, code.range,
                   frame, callee);
    if (!in.is_2021()) in.bind_module_depth();
    run_module_body(module, callee);
  }
  in.make_node(Group{.is_call = true}, code, mark);
}

// --- Built-in modules -------------------------------------------------------

void run_builtin_module(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<BuiltinModuleCode>(instantiation);
  if (!code.deprecated_for.empty()) {
    frame.in.deprecate(code.range,
                       fmt::format("The {}() module will be removed in future "
                                   "releases. Use {} instead.",
                                   code.name, code.deprecated_for));
  }
  code.handler(code, frame);
}

void run_unknown_module(const InstantiationCode& code, Frame& frame) {
  frame.in.warn_of_unknown(Named::kModule, code.range, code.name);
}

// --- Control ----------------------------------------------------------------

void run_if(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<IfCode>(instantiation);
  const std::size_t mark = frame.in.node_mark();
  if (run(code.condition, frame).is_true()) {
    run_block(*code.block, frame);
  } else if (code.otherwise != nullptr) {
    run_block(*code.otherwise, frame);
  } else {
    return;
  }
  frame.in.make_node(Group{}, code, mark);
}

namespace {

// Runs the loops over the bindings from `level` on, one inside the other.
void run_loop(const ForCode& code, std::size_t level, Frame& frame) {
  Interpreter& in = frame.in;
  if (level == code.bindings.size()) {
    if (level == 0) return;
    const DynamicScope scope(in);
    run_block(*code.block, frame);
    return;
  }
  const Binding& binding = code.bindings[level];
  const Value values = run(binding.value, frame);
  const DynamicScope scope(in);
  const auto round = [&](Value value) {
    in.count_step();
    in.unwind(scope.mark());
    in.assign(binding.target, std::move(value), frame);
    run_loop(code, level + 1, frame);
  };
  for_each_value(values, kMostStatementElements, code.range, frame, round);
}

}  // namespace

void run_for(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<ForCode>(instantiation);
  const std::size_t mark = frame.in.node_mark();
  run_loop(code, 0, frame);
  if (code.is_intersection) {
    frame.in.make_node(Intersection{}, code, mark);
  } else {
    frame.in.make_node(Group{}, code, mark);
  }
}

void run_let_module(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<LetModuleCode>(instantiation);
  const std::size_t mark = frame.in.node_mark();
  unset(code.resets, frame);
  run_bindings(code.bindings, frame);
  run_block(*code.block, frame);
  frame.in.make_node(Group{}, code, mark);
}

void run_assign(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<LetModuleCode>(instantiation);
  const std::size_t mark = frame.in.node_mark();
  frame.in.deprecate(code.range,
                     "The assign() module will be removed in future releases. "
                     "Use a regular assignment instead.");
  std::vector<Value> values;
  for (const Binding& binding : code.bindings) {
    values.push_back(run(binding.value, frame));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    frame.in.assign(code.bindings[i].target, std::move(values[i]), frame);
  }
  run_block(*code.block, frame);
  frame.in.make_node(Group{}, code, mark);
}

void run_assert_module(const InstantiationCode& instantiation, Frame& frame) {
  const auto& code = as<AssertModuleCode>(instantiation);
  const std::size_t mark = frame.in.node_mark();
  run_assert(*code.assertion, frame);
  run_block(*code.block, frame);
  if (frame.in.node_mark() > mark) frame.in.make_node(Group{}, code, mark);
}

}  // namespace lamina::csg
