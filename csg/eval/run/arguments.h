#pragma once
// Evaluating the arguments of a call.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "csg/eval/run/interpreter.h"

namespace lamina::csg {

// `$` variables, by number, and the values that a call gives them.
using DynamicValues = std::vector<std::pair<std::uint32_t, Value>>;

// Evaluates arguments in the order of the plan and hands each to
// `set(target, value)`. Returns those that the caller has to bind once it has
// evaluated the fallbacks.
template <typename Set>
[[gnu::always_inline]] inline DynamicValues run_arguments(
    const ArgumentPlan& plan, std::span<const WrittenArgument> arguments,
    Frame& caller, const Set& set) {
  DynamicValues values;
  for (const BoundArgument& bound : plan.bound) {
    Value value = run(arguments[bound.written].value, caller);
    if (plan.evaluates_fallbacks_last &&
        bound.target.kind == Target::Kind::kDynamic) {
      values.emplace_back(bound.target.index, std::move(value));
    } else {
      set(bound.target, std::move(value));
    }
  }
  return values;
}

inline void bind(DynamicValues&& values, Interpreter& in) {
  for (auto& [index, value] : values) in.bind_dynamic(index, std::move(value));
}

}  // namespace lamina::csg
