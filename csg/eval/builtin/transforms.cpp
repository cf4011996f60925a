// Modules that move their children: scale, rotate, mirror, translate,
// multmatrix.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "csg/degrees.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

// GLM's matrices are columns of rows.
void set(Mat4& matrix, int row, int column, double value) {
  matrix[column][row] = value;
}

// OpenSCAD multiplies matrices that scale and turn by the identity, which makes
// a column NaN where a number in it is not finite.
Mat4 times_identity(const Mat4& matrix) {
  Mat4 product = matrix;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      const double others =
          matrix[column][(row + 1) % 3] + matrix[column][(row + 2) % 3];
      if (!std::isfinite(others)) product[column][row] += 0.0 * others;
    }
  }
  return product;
}

Mat4 scale_matrix(const ModuleCall& call) {
  const Value& v = call["v"];
  Vec3 factors(1.0);
  if (!read_vec3(v, 1.0, factors)) {
    if (v.is_number()) {
      factors = Vec3(v.as_number());
    } else {
      call.warn(
          "Unable to convert scale({}) parameter to a number, a vec3 or vec2 "
          "of numbers or a number",
          to_echo(v));
    }
  }
  const auto is_fine = [](double x) { return x != 0 && std::isfinite(x); };
  if (call.in.options().check_ranges &&
      !(is_fine(factors.x) && is_fine(factors.y) && is_fine(factors.z))) {
    call.warn("scale({})", to_echo(v));
  }
  Mat4 matrix(1.0);
  for (int i = 0; i < 3; ++i) set(matrix, i, i, factors[i]);
  return times_identity(matrix);
}

// About x, then y, then z.
Mat4 euler_matrix(const Value& a, const Value& v, const ModuleCall& call) {
  const std::span<const Value> angles = a.as_vector();
  double sine[3] = {0, 0, 0};
  double cosine[3] = {1, 1, 1};
  bool is_fine = angles.size() <= 3;
  double angle = 0;
  for (std::size_t i = std::min<std::size_t>(angles.size(), 3); i-- > 0;) {
    if (angles[i].is_number()) {
      angle = angles[i].as_number();
    } else {
      is_fine = false;
    }
    if (!std::isfinite(angle)) is_fine = false;
    sine[i] = sin_deg(angle);
    cosine[i] = cos_deg(angle);
  }
  const bool has_axis = !v.is_undef();
  if (is_fine && has_axis) {
    call.warn(
        "When parameter a is supplied as vector, v is ignored rotate(a={}, "
        "v={})",
        to_echo(a), to_echo(v));
  } else if (!is_fine && has_axis) {
    call.warn("Problem converting rotate(a={}, v={}) parameter", to_echo(a),
              to_echo(v));
  } else if (!is_fine) {
    call.warn("Problem converting rotate(a={}) parameter", to_echo(a));
  }
  const auto [sx, sy, sz] = sine;
  const auto [cx, cy, cz] = cosine;
  Mat4 matrix(1.0);
  set(matrix, 0, 0, cy * cz);
  set(matrix, 0, 1, cz * sx * sy - cx * sz);
  set(matrix, 0, 2, cx * cz * sy + sx * sz);
  set(matrix, 1, 0, cy * sz);
  set(matrix, 1, 1, cx * cz + sx * sy * sz);
  set(matrix, 1, 2, -cz * sx + cx * sy * sz);
  set(matrix, 2, 0, -sy);
  set(matrix, 2, 1, cy * sx);
  set(matrix, 2, 2, cx * cy);
  return matrix;
}

// About an axis of any length, by Rodrigues' formula.
Mat4 axis_matrix(double angle, const Vec3& v) {
  Mat4 matrix(1.0);
  const double squared = v.x * v.x + v.y * v.y + v.z * v.z;
  if (!(squared > 0)) return matrix;
  const double s = sin_deg(angle);
  const double c = cos_deg(angle);
  const Vec3 cv = v * ((1 - c) / squared);
  const Vec3 us = v / std::sqrt(squared) * s;
  set(matrix, 0, 0, cv.x * v.x + c);
  set(matrix, 0, 1, cv.y * v.x - us.z);
  set(matrix, 0, 2, cv.z * v.x + us.y);
  set(matrix, 1, 0, cv.x * v.y + us.z);
  set(matrix, 1, 1, cv.y * v.y + c);
  set(matrix, 1, 2, cv.z * v.y - us.x);
  set(matrix, 2, 0, cv.x * v.z - us.y);
  set(matrix, 2, 1, cv.y * v.z + us.x);
  set(matrix, 2, 2, cv.z * v.z + c);
  return matrix;
}

Mat4 rotation_matrix(const ModuleCall& call) {
  const Value& a = call["a"];
  const Value& v = call["v"];
  if (a.is_vector()) return times_identity(euler_matrix(a, v, call));
  const std::optional<double> angle = to_finite(a);
  Vec3 axis(0, 0, 1);
  const bool has_axis = read_vec3(v, 0.0, axis);
  if (!v.is_undef() && !has_axis) {
    if (angle) {
      call.warn("Problem converting rotate(..., v={}) parameter", to_echo(v));
    } else {
      call.warn("Problem converting rotate(a={}, v={}) parameter", to_echo(a),
                to_echo(v));
    }
  } else if (!angle) {
    call.warn("Problem converting rotate(a={}) parameter", to_echo(a));
  }
  return times_identity(axis_matrix(angle.value_or(0.0), axis));
}

Mat4 mirror_matrix(const ModuleCall& call) {
  const Value& v = call["v"];
  Vec3 n(1, 0, 0);
  if (!read_vec3(v, 0.0, n)) {
    call.warn(
        "Unable to convert mirror({}) parameter to a vec3 or vec2 of numbers",
        to_echo(v));
  }
  Mat4 matrix(1.0);
  if (n == Vec3(0.0)) return matrix;
  const double squared = n.x * n.x + n.y * n.y + n.z * n.z;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double reflected = -2 * n[column] * n[row] / squared;
      set(matrix, row, column, row == column ? 1 + reflected : reflected);
    }
  }
  return matrix;
}

Mat4 translation_matrix(const ModuleCall& call) {
  const Value& v = call["v"];
  Vec3 shift(0.0);
  const bool is_fine = read_vec3(v, 0.0, shift) && std::isfinite(shift.x) &&
                       std::isfinite(shift.y) && std::isfinite(shift.z);
  Mat4 matrix(1.0);
  if (!is_fine) {
    call.warn(
        "Unable to convert translate({}) parameter to a vec3 or vec2 of "
        "numbers",
        to_echo(v));
    return matrix;
  }
  for (int i = 0; i < 3; ++i) set(matrix, i, 3, shift[i]);
  return matrix;
}

// The identity with the elements that the rows give, divided by the last
// element.
Mat4 given_matrix(const ModuleCall& call) {
  Mat4 matrix(1.0);
  const std::span<const Value> rows = call["m"].elements();
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), 4); ++i) {
    const std::span<const Value> row = rows[i].elements();
    for (std::size_t j = 0; j < std::min<std::size_t>(row.size(), 4); ++j) {
      if (row[j].is_number()) {
        set(matrix, static_cast<int>(i), static_cast<int>(j),
            row[j].as_number());
      }
    }
  }
  const double w = matrix[3][3];
  if (w != 1.0) {
    for (int i = 0; i < 4; ++i) matrix[i] /= w;
  }
  return matrix;
}

using MakeMatrix = Mat4(const ModuleCall&);

template <MakeMatrix make>
Transform transform(const ModuleCall& call) {
  return {call.in.keep_matrix(make(call))};
}

}  // namespace

std::vector<BuiltinModuleRow> transform_rows() {
  return {
      {"scale", run_operation<transform<scale_matrix>>, {"v"}},
      {"rotate", run_operation<transform<rotation_matrix>>, {"a", "v"}},
      {"mirror", run_operation<transform<mirror_matrix>>, {"v"}},
      {"translate", run_operation<transform<translation_matrix>>, {"v"}},
      {"multmatrix", run_operation<transform<given_matrix>>, {"m"}},
  };
}

}  // namespace lamina::csg
