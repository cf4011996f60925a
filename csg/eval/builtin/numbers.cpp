// Built-in functions of numbers (see functions.h).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "csg/degrees.h"
#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/operators.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

double tan_deg(double x) {
  // Beyond this the fraction of a turn is lost.
  constexpr double kHuge = 360.0 * 0x1p52;
  if (!(std::fabs(x) < kHuge)) return std::numeric_limits<double>::quiet_NaN();
  const auto cycles = static_cast<std::int64_t>(std::floor(x / 180.0));
  x -= 180.0 * static_cast<double>(cycles);
  const bool is_even = cycles % 2 == 0;
  const bool is_opposed = x > 90.0;
  if (is_opposed) x = 180.0 - x;
  double tangent = 0;
  if (x == 0.0) {
    tangent = is_even ? 0.0 : -0.0;
  } else if (x == 30.0) {
    tangent = std::sqrt(1.0 / 3.0);
  } else if (x == 45.0) {
    tangent = 1.0;
  } else if (x == 60.0) {
    tangent = std::sqrt(3.0);
  } else if (x == 90.0) {
    tangent = is_even ? std::numeric_limits<double>::infinity()
                      : -std::numeric_limits<double>::infinity();
  } else {
    tangent = std::tan(x * (std::numbers::pi / 180.0));
  }
  return is_opposed ? -tangent : tangent;
}

double to_degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}
// A whole number of degrees where that is exact.
template <double (*function)(double)>
double exact_degrees(double degrees, double x) {
  const double whole = std::round(degrees);
  return function(whole) == x ? whole : degrees;
}
double asin_deg(double x) {
  return exact_degrees<sin_deg>(to_degrees(std::asin(x)), x);
}
double acos_deg(double x) {
  return exact_degrees<cos_deg>(to_degrees(std::acos(x)), x);
}
double atan_deg(double x) {
  return exact_degrees<tan_deg>(to_degrees(std::atan(x)), x);
}

template <double (*function)(double, double)>
Value of_two_numbers(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 2) return wrong_count(code, frame, "2");
  const Value a = argument(code, 0, frame);
  const Value b = argument(code, 1, frame);
  if (!a.is_number()) return wrong_type(code, frame, 0, Type::kNumber, a);
  if (!b.is_number()) return wrong_type(code, frame, 1, Type::kNumber, b);
  return Value(function(a.as_number(), b.as_number()));
}
double math_pow(double x, double y) { return std::pow(x, y); }

Value builtin_log(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n != 1 && n != 2) return wrong_count(code, frame, "2");
  const Value first = argument(code, 0, frame);
  if (!first.is_number()) {
    run_rest(code, 1, frame);
    return wrong_type(code, frame, 0, Type::kNumber, first);
  }
  double base = 10.0;
  double x = first.as_number();
  if (n == 2) {
    const Value second = argument(code, 1, frame);
    if (!second.is_number()) {
      return wrong_type(code, frame, 1, Type::kNumber, second);
    }
    base = x;
    x = second.as_number();
  }
  return Value(std::log(x) / std::log(base));
}

// min and max: of numbers, or of the elements of one vector; 2021.01 compares
// these by `<`, whatever they are.
template <bool is_max>
Value extreme_element(std::span<const Value> values, const CallCode& code,
                      Frame& frame) {
  if (values.empty()) {
    return warn(code, frame,
                "{}() number of parameters does not match: expected at least 1 "
                "vector element, found 0",
                code.name);
  }
  double result = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i].is_number()) {
      return warn(code, frame,
                  "{}() parameter could not be converted: vector element {}: "
                  "expected number, found {} ({})",
                  code.name, i, type_name(values[i].type()),
                  to_echo(values[i]));
    }
    const double x = values[i].as_number();
    if (i == 0 || (is_max ? x > result : x < result)) result = x;
  }
  return Value(result);
}

template <bool is_max>
Value extreme(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n == 0) return wrong_count(code, frame, "at least 1");
  const Value first = argument(code, 0, frame);
  if (n == 1 && first.is_vector() && !frame.in.is_2021()) {
    return extreme_element<is_max>(first.as_vector(), code, frame);
  }
  if (n == 1 && first.is_vector() && !first.as_vector().empty()) {
    const std::span<const Value> values = first.as_vector();
    return is_max ? *std::max_element(values.begin(), values.end(), is_less)
                  : *std::min_element(values.begin(), values.end(), is_less);
  }
  if (!first.is_number()) {
    run_rest(code, 1, frame);
    return wrong_type(code, frame, 0, Type::kNumber, first);
  }
  double result = first.as_number();
  for (std::size_t i = 1; i < n; ++i) {
    const Value value = argument(code, i, frame);
    if (!value.is_number()) {
      run_rest(code, i + 1, frame);
      return wrong_type(code, frame, i, Type::kNumber, value);
    }
    const double x = value.as_number();
    if (is_max ? x > result : x < result) result = x;
  }
  return Value(result);
}

// The seed that OpenSCAD makes of a number (the hash that Python has for
// floating-point numbers, of 31 bits).
std::uint32_t hash_number(double v) {
  constexpr int kBits = 31;
  constexpr std::uint32_t kModulus = (1U << kBits) - 1;
  constexpr std::uint32_t kInfinity = 314159;
  if (std::isnan(v)) return 0;
  if (std::isinf(v)) return v > 0 ? kInfinity : -kInfinity;
  int exponent = 0;
  double mantissa = std::frexp(v, &exponent);
  const bool is_negative = mantissa < 0;
  mantissa = std::fabs(mantissa);
  std::uint32_t x = 0;
  while (mantissa != 0) {
    x = (x << 28 & kModulus) | x >> (kBits - 28);
    mantissa *= 0x1p28;
    exponent -= 28;
    const auto y = static_cast<std::uint32_t>(mantissa);
    mantissa -= y;
    x += y;
    if (x >= kModulus) x -= kModulus;
  }
  exponent =
      exponent >= 0 ? exponent % kBits : kBits - 1 - (-1 - exponent) % kBits;
  x = (x << exponent & kModulus) | x >> (kBits - exponent);
  return is_negative ? -x : x;
}

// A finite number for an end of the range of rands().
double finite_or(double x, double fallback, std::string_view which,
                 const CallCode& code, Frame& frame) {
  if (std::isfinite(x)) return x;
  warn(code, frame, "rands() range {} cannot be infinite", which);
  frame.in.warn({}, fmt::format("resetting to {:f}", fallback));
  return fallback;
}

Value builtin_rands(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n != 3 && n != 4) return wrong_count(code, frame, "3 or 4");
  ++frame.in.effects();
  constexpr double kHalfOfAll = std::numeric_limits<double>::max() / 2;
  const Value first = argument(code, 0, frame);
  if (!first.is_number()) {
    run_rest(code, 1, frame);
    return newly_wrong_type(code, frame, 0, Type::kNumber, first);
  }
  double least = finite_or(first.as_number(), -kHalfOfAll, "min", code, frame);
  const Value second = argument(code, 1, frame);
  if (!second.is_number()) {
    run_rest(code, 2, frame);
    return newly_wrong_type(code, frame, 1, Type::kNumber, second);
  }
  double most = finite_or(second.as_number(), kHalfOfAll, "max", code, frame);
  if (most < least) std::swap(least, most);
  const Value third = argument(code, 2, frame);
  if (!third.is_number()) {
    run_rest(code, 3, frame);
    return newly_wrong_type(code, frame, 2, Type::kNumber, third);
  }
  double count = std::fabs(third.as_number());
  if (!std::isfinite(count)) {
    warn(code, frame, "rands() cannot create an infinite number of results");
    frame.in.warn({}, "resetting number of results to 1");
    count = 1;
  }
  if (n == 4) {
    const Value seed = argument(code, 3, frame);
    if (!seed.is_number()) {
      return newly_wrong_type(code, frame, 3, Type::kNumber, seed);
    }
    frame.in.random.seed(hash_number(seed.as_number()));
  }
  // No memory holds so many: making the list fails.
  constexpr double kFarTooMany = 0x1p60;
  const auto results = static_cast<std::size_t>(std::min(count, kFarTooMany));
  VectorBuilder out(results);
  std::uniform_real_distribution<> distribution(least, most);
  for (std::size_t i = 0; i < results; ++i) {
    out.push(Value(least < most ? distribution(frame.in.random) : least));
  }
  return out.finish();
}

}  // namespace

std::span<const BuiltinFunctionRow> number_rows() {
  static constexpr BuiltinFunctionRow kRows[] = {
      {"abs", call_math, [](double x) { return std::fabs(x); }},
      {"sign", call_math,
       [](double x) { return x < 0   ? -1.0
                             : x > 0 ? 1.0
                                     : 0.0; }},
      {"sin", call_math, sin_deg},
      {"cos", call_math, cos_deg},
      {"tan", call_math, tan_deg},
      {"asin", call_math, asin_deg},
      {"acos", call_math, acos_deg},
      {"atan", call_math, atan_deg},
      {"round", call_math, [](double x) { return std::round(x); }},
      {"ceil", call_math, [](double x) { return std::ceil(x); }},
      {"floor", call_math, [](double x) { return std::floor(x); }},
      {"sqrt", call_math, [](double x) { return std::sqrt(x); }},
      {"exp", call_math, [](double x) { return std::exp(x); }},
      {"ln", call_math, [](double x) { return std::log(x); }},
      {"atan2", of_two_numbers<atan2_deg>},
      {"pow", of_two_numbers<math_pow>},
      {"log", builtin_log},
      {"min", extreme<false>},
      {"max", extreme<true>},
      {"rands", builtin_rands},
  };
  return kRows;
}

}  // namespace lamina::csg
