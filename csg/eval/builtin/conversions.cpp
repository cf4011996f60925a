#include "csg/eval/builtin/conversions.h"

#include <cmath>

#include "csg/eval/value/operators.h"

namespace lamina::csg {

std::optional<Vec2> to_vec2(const Value& value) {
  const std::span<const Value> v = value.elements();
  if (v.size() != 2 || !v[0].is_number() || !v[1].is_number()) {
    return std::nullopt;
  }
  return Vec2(v[0].as_number(), v[1].as_number());
}

std::optional<Vec3> to_vec3(const Value& value) {
  const std::span<const Value> v = value.elements();
  if (v.size() != 3 || !v[0].is_number() || !v[1].is_number() ||
      !v[2].is_number()) {
    return std::nullopt;
  }
  return Vec3(v[0].as_number(), v[1].as_number(), v[2].as_number());
}

std::optional<Vec3> to_vec3(const Value& value, double z) {
  if (const std::optional<Vec2> flat = to_vec2(value)) return Vec3(*flat, z);
  return to_vec3(value);
}

bool read_vec3(const Value& value, double default_z, Vec3& target) {
  const std::span<const Value> v = value.elements();
  if (v.size() == 2) {
    if (const std::optional<Vec2> flat = to_vec2(value)) {
      target.x = flat->x;
      target.y = flat->y;
    }
    target.z = default_z;
    return true;
  }
  if (v.size() != 3) return false;
  for (int i = 0; i < 3; ++i) {
    if (!v[static_cast<std::size_t>(i)].is_number()) return false;
    target[i] = v[static_cast<std::size_t>(i)].as_number();
  }
  return true;
}

std::optional<double> to_finite(const Value& value) {
  if (!value.is_number() || !std::isfinite(value.as_number())) {
    return std::nullopt;
  }
  return value.as_number();
}

int to_int(const Value& value) { return cut_to<int>(value.number_or_zero()); }

Facets current_facets(Interpreter& in) {
  return {in.dynamic_number(kFn), in.dynamic_number(kFa),
          in.dynamic_number(kFs), in.is_2021() ? 0 : in.dynamic_number(kFe)};
}

}  // namespace lamina::csg
