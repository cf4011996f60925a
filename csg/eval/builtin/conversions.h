#pragma once
// Values as the parameters of modules: numbers, vectors, `$fn $fa $fs`.

#include <optional>
#include <string_view>

#include "base/vec.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/value.h"
#include "csg/tree.h"

namespace lamina::csg {

// A vector of exactly two numbers.
std::optional<Vec2> to_vec2(const Value& value);
// A vector of exactly three numbers.
std::optional<Vec3> to_vec3(const Value& value);
// A vector of three numbers, or of two with `z` for the third.
std::optional<Vec3> to_vec3(const Value& value, double z);
// Reads a vector of two or three elements into `target`. False for anything
// else; elements that come before one that is not a number are written all the
// same, as OpenSCAD does.
bool read_vec3(const Value& value, double default_z, Vec3& target);

std::optional<double> to_finite(const Value& value);

// Whether the value is `true` itself, not just what `if` takes for it.
inline bool is_set(const Value& value) {
  return value.is_bool() && value.as_bool();
}
inline double number_or(const Value& value, double fallback) {
  return value.is_number() ? value.as_number() : fallback;
}
// A view of the value's characters.
inline std::string_view string_or(const Value& value,
                                  std::string_view fallback) {
  return value.is_string() ? value.as_string() : fallback;
}

// The number cut to an int as OpenSCAD cuts it; 0 for any other value.
int to_int(const Value& value);

// `$fn $fa $fs`, and in 2026 `$fe`, as in force now.
Facets current_facets(Interpreter& in);

}  // namespace lamina::csg
