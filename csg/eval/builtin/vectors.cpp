// Built-in functions of vectors (see functions.h).

#include <cmath>
#include <optional>

#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

Value builtin_concat(const CallCode& code, Frame& frame) {
  VectorGrower grower;
  for (const WrittenArgument& written : code.arguments) {
    Value spill;
    const Value& more = look(written.value, frame, spill);
    if (more.is_vector()) {
      grower.push_all(more);
    } else {
      grower.push(more);
    }
  }
  return grower.finish();
}

Value builtin_norm(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame, "1");
  const Value value = argument(code, 0, frame);
  if (!value.is_vector()) {
    return newly_wrong_type(code, frame, 0, Type::kVector, value);
  }
  double sum = 0;
  for (const Value& element : value.as_vector()) {
    if (!element.is_number()) {
      return warn(code, frame, "Incorrect arguments to norm()");
    }
    sum += element.as_number() * element.as_number();
  }
  return Value(std::sqrt(sum));
}

Value builtin_cross(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 2) {
    return frame.in.is_2021()
               ? warn(code, frame, "Invalid number of parameters for cross()")
               : wrong_count(code, frame, "2");
  }
  const Value first = argument(code, 0, frame);
  const Value second = argument(code, 1, frame);
  if (!first.is_vector() || !second.is_vector()) {
    const std::size_t wrong = first.is_vector() ? 1 : 0;
    return frame.in.is_2021()
               ? warn(code, frame, "Invalid type of parameters for cross()")
               : wrong_type(code, frame, wrong, Type::kVector,
                            wrong == 0 ? first : second);
  }
  const std::span<const Value> a = first.as_vector();
  const std::span<const Value> b = second.as_vector();
  const auto minor = [&](std::size_t i, std::size_t k) {
    return a[i].number_or_zero() * b[k].number_or_zero() -
           a[k].number_or_zero() * b[i].number_or_zero();
  };
  if (a.size() == 2 && b.size() == 2) return Value(minor(0, 1));
  if (a.size() != 3 || b.size() != 3) {
    return warn(code, frame, "Invalid vector size of parameter for cross()");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!a[i].is_number() || !b[i].is_number()) {
      return warn(code, frame, "Invalid value in parameter vector for cross()");
    }
    if (std::isnan(a[i].as_number()) || std::isnan(b[i].as_number())) {
      return warn(code, frame,
                  "Invalid value (NaN) in parameter vector for cross()");
    }
    if (std::isinf(a[i].as_number()) || std::isinf(b[i].as_number())) {
      return warn(code, frame,
                  "Invalid value (INF) in parameter vector for cross()");
    }
  }
  const double product[] = {minor(1, 2), minor(2, 0), minor(0, 1)};
  return Value::numbers(product);
}

// Linear interpolation in a table of pairs, which need not be sorted.
Value builtin_lookup(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 2) return wrong_count(code, frame, "2");
  const Value key = argument(code, 0, frame);
  if (!key.is_number() && !frame.in.is_2021()) {
    run_rest(code, 1, frame);
    return wrong_type(code, frame, 0, Type::kNumber, key);
  }
  if (!key.is_number() || !std::isfinite(key.as_number())) {
    return warn(code, frame, "lookup({}, ...) first argument is not a number",
                to_echo(argument(code, 0, frame)));
  }
  const Value table = argument(code, 1, frame);
  if (!table.is_vector()) {
    return newly_wrong_type(code, frame, 1, Type::kVector, table);
  }
  const std::optional<double> found =
      frame.in.lookup_tables().find(table, key.as_number());
  return found ? Value(*found) : Value();
}

}  // namespace

std::span<const BuiltinFunctionRow> vector_rows() {
  static constexpr BuiltinFunctionRow kRows[] = {
      {"concat", builtin_concat},
      {"norm", builtin_norm},
      {"cross", builtin_cross},
      {"lookup", builtin_lookup},
  };
  return kRows;
}

}  // namespace lamina::csg
