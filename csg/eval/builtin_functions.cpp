#include "csg/eval/builtin_functions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <unordered_map>

#include <fmt/format.h>

#include "csg/degrees.h"
#include "csg/eval/builtin_dxf.h"
#include "csg/eval/builtin_objects.h"
#include "csg/eval/interpreter.h"
#include "csg/eval/object.h"
#include "csg/eval/operators.h"
#include "csg/eval/text.h"
#include "csg/eval/utf8.h"

namespace lamina::csg {

namespace {

Value argument(const CallCode& code, std::size_t i, Frame& frame) {
  return run(code.arguments[i].value, frame);
}

[[gnu::noinline]] Value warn(const CallCode& code, Frame& frame,
                             std::string message) {
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

// --- Numbers ----------------------------------------------------------------

double sign(double x) { return x < 0 ? -1.0 : x > 0 ? 1.0 : 0.0; }

double tan_deg(double x) {
  // Beyond this the fraction of a turn is lost.
  constexpr double kHuge = 360.0 * 0x1p52;
  const auto cycles = std::fabs(x) < kHuge
                          ? static_cast<std::int64_t>(std::floor(x / 180.0))
                          : 0;
  if (x < 180.0 && x >= 0.0) {
    // Already in the first half turn.
  } else if (x < kHuge && x > -kHuge) {
    x -= 180.0 * static_cast<double>(cycles);
  } else {
    return std::numeric_limits<double>::quiet_NaN();
  }
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
double atan2_deg(double y, double x) {
  const double degrees = to_degrees(std::atan2(y, x));
  const double whole = std::round(degrees);
  return std::fabs(degrees - whole) < 3.0E-14 ? whole : degrees;
}

double math_abs(double x) { return std::fabs(x); }
double math_round(double x) { return std::round(x); }
double math_ceil(double x) { return std::ceil(x); }
double math_floor(double x) { return std::floor(x); }
double math_sqrt(double x) { return std::sqrt(x); }
double math_exp(double x) { return std::exp(x); }
double math_ln(double x) { return std::log(x); }

template <double (*function)(double, double)>
Value of_two_numbers(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 2) return wrong_count(code, frame);
  const Value a = argument(code, 0, frame);
  const Value b = argument(code, 1, frame);
  if (!a.is_number() || !b.is_number()) return wrong_type(code, frame);
  return Value(function(a.as_number(), b.as_number()));
}
double math_pow(double x, double y) { return std::pow(x, y); }

Value builtin_log(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n != 1 && n != 2) return wrong_count(code, frame);
  const Value first = argument(code, 0, frame);
  if (!first.is_number()) return wrong_type(code, frame);
  double base = 10.0;
  double x = first.as_number();
  if (n == 2) {
    const Value second = argument(code, 1, frame);
    if (!second.is_number()) return wrong_type(code, frame);
    base = x;
    x = second.as_number();
  }
  return Value(std::log(x) / std::log(base));
}

// min and max: of one vector by `<`, else of numbers. `is_better(a, b)`: take
// a over b.
template <bool is_max>
Value extreme(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n == 0) return wrong_count(code, frame);
  const Value first = argument(code, 0, frame);
  if (n == 1 && first.is_vector() && !first.as_vector().empty()) {
    const std::span<const Value> values = first.as_vector();
    return is_max ? *std::max_element(values.begin(), values.end(), is_less)
                  : *std::min_element(values.begin(), values.end(), is_less);
  }
  if (!first.is_number()) return wrong_type(code, frame);
  double result = first.as_number();
  for (std::size_t i = 1; i < n; ++i) {
    const Value value = argument(code, i, frame);
    if (!value.is_number()) return wrong_type(code, frame);
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
  warn(code, frame, fmt::format("rands() range {} cannot be infinite", which));
  frame.in.warn({}, fmt::format("resetting to {:f}", fallback));
  return fallback;
}

Value builtin_rands(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n != 3 && n != 4) return wrong_count(code, frame);
  ++frame.in.effects();
  constexpr double kHalfOfAll = std::numeric_limits<double>::max() / 2;
  const Value first = argument(code, 0, frame);
  if (!first.is_number()) return Value();
  double least = finite_or(first.as_number(), -kHalfOfAll, "min", code, frame);
  const Value second = argument(code, 1, frame);
  if (!second.is_number()) return Value();
  double most = finite_or(second.as_number(), kHalfOfAll, "max", code, frame);
  if (most < least) std::swap(least, most);
  const Value third = argument(code, 2, frame);
  if (!third.is_number()) return Value();
  double count = std::fabs(third.as_number());
  if (!std::isfinite(count)) {
    warn(code, frame, "rands() cannot create an infinite number of results");
    frame.in.warn({}, "resetting number of results to 1");
    count = 1;
  }
  if (n == 4) {
    const Value seed = argument(code, 3, frame);
    if (!seed.is_number()) return Value();
    frame.in.random.seed(hash_number(seed.as_number()));
  }
  const auto results = static_cast<std::size_t>(count);
  VectorBuilder out(results);
  std::uniform_real_distribution<> distribution(least, most);
  for (std::size_t i = 0; i < results; ++i) {
    out.push(Value(least < most ? distribution(frame.in.random) : least));
  }
  return out.finish();
}

// --- Strings ----------------------------------------------------------------

Value builtin_str(const CallCode& code, Frame& frame) {
  // Mostly the first argument is what was built so far: append to it.
  if (code.arguments.empty()) return Value::string("");
  Value result = argument(code, 0, frame);
  std::string text;
  if (!result.is_string()) {
    append_text(result, text);
    result = Value();
  }
  for (std::size_t i = 1; i < code.arguments.size(); ++i) {
    Value spill;
    append_text(look(code.arguments[i].value, frame, spill), text);
  }
  return result.is_string() ? result.with_appended(text) : Value::string(text);
}

void append_characters(const Value& value, Frame& frame, std::string& text) {
  switch (value.type()) {
    case Type::kNumber:
      append_utf8(value.as_number(), text);
      return;
    case Type::kVector:
      for (const Value& element : value.as_vector()) {
        append_characters(element, frame, text);
      }
      return;
    case Type::kRange: {
      const Range& range = value.as_range();
      const std::uint32_t count = range.count();
      if (count >= kMostStatementElements) {
        frame.in.warn({}, fmt::format("Bad range parameter in for statement: "
                                      "too many elements ({}).",
                                      count));
        return;
      }
      if (range.step == 0) return;
      for (std::uint32_t i = 0; i < count; ++i) append_utf8(range.at(i), text);
      return;
    }
    default:
      return;
  }
}

Value builtin_chr(const CallCode& code, Frame& frame) {
  std::string text;
  for (std::size_t i = 0; i < code.arguments.size(); ++i) {
    append_characters(argument(code, i, frame), frame, text);
  }
  return Value::string(text);
}

Value builtin_ord(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n == 0) return Value();
  if (n > 1) {
    return warn(code, frame,
                fmt::format("ord() called with {} arguments, only 1 argument "
                            "expected",
                            n));
  }
  const Value value = argument(code, 0, frame);
  if (!value.is_string()) {
    return warn(code, frame,
                fmt::format("ord() argument {} is not of type "
                            "string",
                            to_echo(value)));
  }
  // OpenSCAD sees a string end at its first zero byte.
  std::string_view text = value.as_string();
  text = text.substr(0, text.find('\0'));
  if (!is_valid_utf8(text)) {
    return warn(code, frame,
                fmt::format("ord() argument '{}' is not a valid "
                            "utf8 string",
                            text));
  }
  if (text.empty()) return Value();
  return Value(static_cast<double>(first_code_point(text)));
}

Value builtin_len(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  const Value& value = look(code.arguments[0].value, frame, spill);
  if (value.is_vector()) {
    return Value(static_cast<double>(value.as_vector().size()));
  }
  if (value.is_string()) {
    return Value(static_cast<double>(value.character_count()));
  }
  if (value.is_object()) {
    return Value(static_cast<double>(value.as_object().places.size()));
  }
  return wrong_type(code, frame);
}

// --- Vectors ----------------------------------------------------------------

Value builtin_concat(const CallCode& code, Frame& frame) {
  if (code.arguments.empty()) return Value::vector({});
  Value result = argument(code, 0, frame);
  if (!result.is_vector()) result = Value::vector({&result, 1});
  for (std::size_t i = 1; i < code.arguments.size(); ++i) {
    Value spill;
    const Value& more = look(code.arguments[i].value, frame, spill);
    result = more.is_vector()
                 ? result.with_appended(more.as_vector())
                 : result.with_appended(std::span<const Value>(&more, 1));
  }
  return result;
}

Value builtin_norm(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  const Value value = argument(code, 0, frame);
  if (!value.is_vector()) return Value();
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
    return warn(code, frame, "Invalid number of parameters for cross()");
  }
  const Value first = argument(code, 0, frame);
  const Value second = argument(code, 1, frame);
  if (!first.is_vector() || !second.is_vector()) {
    return warn(code, frame, "Invalid type of parameters for cross()");
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

bool is_pair(const Value& value, double& key, double& result) {
  const std::span<const Value> pair = value.elements();
  if (pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) {
    return false;
  }
  key = pair[0].as_number();
  result = pair[1].as_number();
  return true;
}

// Linear interpolation in a table of pairs, which need not be sorted.
Value builtin_lookup(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 2) return wrong_count(code, frame);
  const Value key = argument(code, 0, frame);
  if (!key.is_number() || !std::isfinite(key.as_number())) {
    return warn(code, frame,
                fmt::format("lookup({}, ...) first argument is not a number",
                            to_echo(argument(code, 0, frame))));
  }
  const double p = key.as_number();
  const Value table = argument(code, 1, frame);
  const std::span<const Value> rows = table.elements();
  double low = 0;
  double low_value = 0;
  if (rows.empty() || !is_pair(rows[0], low, low_value)) return Value();
  double high = low;
  double high_value = low_value;
  for (const Value& row : rows.subspan(1)) {
    double at = 0;
    double value = 0;
    if (!is_pair(row, at, value)) continue;
    if (at <= p && (at > low || low > p)) {
      low = at;
      low_value = value;
    }
    if (at >= p && (at < high || high < p)) {
      high = at;
      high_value = value;
    }
  }
  if (p <= low) return Value(high_value);
  if (p >= high) return Value(low_value);
  const double f = (p - low) / (high - low);
  return Value(high_value * f + low_value * (1 - f));
}

// --- search -----------------------------------------------------------------

struct SearchLimits {
  std::uint32_t matches = 1;  // per value; 0: all
  std::uint32_t column = 0;
};

// What `search` gives for the matches of one value of a list.
void push_matches(std::vector<Value> matches, const SearchLimits& limits,
                  bool keeps_empty, VectorBuilder& out) {
  if (limits.matches != 1) {
    out.push(Value::vector(matches));
  } else if (!matches.empty()) {
    out.push(matches[0]);
  } else if (keeps_empty) {
    out.push(Value::vector({}));
  }
}

// Indices of the elements for which `is_match`, as many as are asked for.
template <typename IsMatch>
std::vector<Value> find_matches(std::size_t count, std::uint32_t most,
                                const IsMatch& is_match) {
  std::vector<Value> matches;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_match(i)) continue;
    matches.emplace_back(static_cast<double>(i));
    if (most != 0 && matches.size() >= most) break;
  }
  return matches;
}

std::vector<Value> find_value(const Value& wanted, std::span<const Value> table,
                              const SearchLimits& limits) {
  return find_matches(table.size(), limits.matches, [&](std::size_t i) {
    if (limits.column == 0 && are_equal(wanted, table[i])) return true;
    const std::span<const Value> row = table[i].elements();
    return limits.column < row.size() && are_equal(wanted, row[limits.column]);
  });
}

std::vector<std::uint32_t> code_points(const Value& text) {
  std::vector<std::uint32_t> points;
  const std::uint32_t count = text.character_count();
  for (std::uint32_t i = 0; i < count; ++i) {
    points.push_back(
        first_code_point(text.as_string().substr(text.character_offset(i))));
  }
  return points;
}

Value search_in_string(const Value& wanted, const Value& text,
                       const SearchLimits& limits) {
  const std::vector<std::uint32_t> table = code_points(text);
  VectorBuilder out;
  for (const std::uint32_t point : code_points(wanted)) {
    push_matches(find_matches(table.size(), limits.matches,
                              [&](std::size_t i) { return table[i] == point; }),
                 limits, false, out);
  }
  return out.finish();
}

// The characters of a string, each among the first characters of a column.
Value search_in_table(const Value& wanted, const Value& table,
                      const SearchLimits& limits, const CallCode& code,
                      Frame& frame) {
  const std::span<const Value> rows = table.elements();
  std::vector<std::uint32_t> firsts;
  std::size_t bad_row = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::span<const Value> row = rows[i].elements();
    if (row.size() <= limits.column) {
      bad_row = i;
      break;
    }
    const std::string text = to_text(row[limits.column]);
    firsts.push_back(text.empty() ? 0 : first_code_point(text));
  }
  VectorBuilder out;
  const std::vector<std::uint32_t> points = code_points(wanted);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::vector<Value> matches =
        find_matches(firsts.size(), limits.matches,
                     [&](std::size_t j) { return firsts[j] == points[i]; });
    const bool is_full =
        limits.matches != 0 && matches.size() >= limits.matches;
    if (bad_row < rows.size() && !is_full) {
      warn(code, frame,
           fmt::format("Invalid entry in search vector at index {}, required "
                       "number of values in the entry: {}. Invalid entry: {}",
                       bad_row, limits.column + 1, to_echo(rows[bad_row])));
      return Value::vector({});
    }
    if (matches.empty()) {
      warn(code, frame,
           fmt::format("search term not found: \"{}\"",
                       to_text(wanted.character(i))));
    }
    push_matches(std::move(matches), limits, false, out);
  }
  return out.finish();
}

std::uint32_t to_count(double number) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
}

Value builtin_search(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n < 2) return wrong_count(code, frame);
  const Value wanted = argument(code, 0, frame);
  const Value table = argument(code, 1, frame);
  SearchLimits limits;
  if (n > 2)
    limits.matches = to_count(argument(code, 2, frame).number_or_zero());
  if (n > 3)
    limits.column = to_count(argument(code, 3, frame).number_or_zero());
  switch (wanted.type()) {
    case Type::kNumber:
      return Value::vector(find_value(wanted, table.elements(), limits));
    case Type::kString:
      return table.is_string()
                 ? search_in_string(wanted, table, limits)
                 : search_in_table(wanted, table, limits, code, frame);
    case Type::kVector: {
      VectorBuilder out;
      for (const Value& one : wanted.as_vector()) {
        push_matches(find_value(one, table.elements(), limits), limits, true,
                     out);
      }
      return out.finish();
    }
    default:
      return Value();
  }
}

// --- About the program ------------------------------------------------------

constexpr double kVersion[] = {2021, 1, 0};

Value builtin_version(const CallCode&, Frame&) {
  return Value::numbers(kVersion);
}

Value builtin_version_num(const CallCode& code, Frame& frame) {
  const Value version = code.arguments.empty() ? Value::numbers(kVersion)
                                               : argument(code, 0, frame);
  const std::span<const Value> parts = version.elements();
  if (parts.size() != 2 && parts.size() != 3) return Value();
  double number = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i < parts.size() && !parts[i].is_number()) return Value();
    number = number * 100 + (i < parts.size() ? parts[i].as_number() : 0);
  }
  return Value(number);
}

Value builtin_parent_module(const CallCode& code, Frame& frame) {
  ++frame.in.effects();
  double number = 1;
  if (code.arguments.size() == 1) {
    const Value value = argument(code, 0, frame);
    if (!value.is_number()) return Value();
    number = value.as_number();
  } else if (code.arguments.size() > 1) {
    return wrong_count(code, frame);
  }
  const int n = static_cast<int>(std::trunc(number));
  const auto& names = frame.in.module_names;
  if (n < 0) {
    return warn(code, frame,
                fmt::format("Negative parent module index ({}) "
                            "not allowed",
                            n));
  }
  if (n >= static_cast<int>(names.size())) {
    return warn(code, frame,
                fmt::format("Parent module index ({}) greater than the number "
                            "of modules on the stack",
                            n));
  }
  return Value::string(names[names.size() - 1 - static_cast<std::size_t>(n)]);
}

template <Type type>
Value is_type(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  return Value(look(code.arguments[0].value, frame, spill).type() == type);
}

Value builtin_is_num(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  const Value& value = look(code.arguments[0].value, frame, spill);
  return Value(value.is_number() && !std::isnan(value.as_number()));
}

using Table = std::unordered_map<std::string_view, BuiltinFunctionEntry>;

const Table& builtin_table() {
  static const Table table = {
      {"abs", {nullptr, math_abs}},
      {"sign", {nullptr, sign}},
      {"sin", {nullptr, sin_deg}},
      {"cos", {nullptr, cos_deg}},
      {"tan", {nullptr, tan_deg}},
      {"asin", {nullptr, asin_deg}},
      {"acos", {nullptr, acos_deg}},
      {"atan", {nullptr, atan_deg}},
      {"round", {nullptr, math_round}},
      {"ceil", {nullptr, math_ceil}},
      {"floor", {nullptr, math_floor}},
      {"sqrt", {nullptr, math_sqrt}},
      {"exp", {nullptr, math_exp}},
      {"ln", {nullptr, math_ln}},
      {"atan2", {of_two_numbers<atan2_deg>, nullptr}},
      {"pow", {of_two_numbers<math_pow>, nullptr}},
      {"log", {builtin_log, nullptr}},
      {"min", {extreme<false>, nullptr}},
      {"max", {extreme<true>, nullptr}},
      {"rands", {builtin_rands, nullptr}},
      {"str", {builtin_str, nullptr}},
      {"chr", {builtin_chr, nullptr}},
      {"ord", {builtin_ord, nullptr}},
      {"len", {builtin_len, nullptr}},
      {"concat", {builtin_concat, nullptr}},
      {"norm", {builtin_norm, nullptr}},
      {"cross", {builtin_cross, nullptr}},
      {"lookup", {builtin_lookup, nullptr}},
      {"search", {builtin_search, nullptr}},
      {"version", {builtin_version, nullptr}},
      {"version_num", {builtin_version_num, nullptr}},
      {"parent_module", {builtin_parent_module, nullptr}},
      {"dxf_dim", {builtin_dxf_dim, nullptr}},
      {"dxf_cross", {builtin_dxf_cross, nullptr}},
      {"is_undef", {builtin_is_undef, nullptr}},
      {"is_bool", {is_type<Type::kBool>, nullptr}},
      {"is_string", {is_type<Type::kString>, nullptr}},
      {"is_list", {is_type<Type::kVector>, nullptr}},
      {"is_function", {is_type<Type::kFunction>, nullptr}},
      {"is_num", {builtin_is_num, nullptr}},
      {"is_object", {builtin_is_object, nullptr}},
      {"object", {builtin_object, nullptr}},
      {"has_key", {builtin_has_key, nullptr}},
      {"import", {builtin_import, nullptr}},
  };
  return table;
}

}  // namespace

Value builtin_is_undef(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  return Value(look(code.arguments[0].value, frame, spill).is_undef());
}

Value call_math(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  const Value& value = look(code.arguments[0].value, frame, spill);
  if (!value.is_number()) return wrong_type(code, frame);
  return Value(code.math(value.as_number()));
}

const BuiltinFunctionEntry* find_builtin_function(std::string_view name) {
  const auto entry = builtin_table().find(name);
  return entry == builtin_table().end() ? nullptr : &entry->second;
}

}  // namespace lamina::csg
