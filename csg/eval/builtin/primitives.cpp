// cube, sphere, cylinder, polyhedron, square, circle, polygon.

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

void refuse_children(const BuiltinModuleCode& code, Frame& frame) {
  if (code.block->statements.empty()) return;
  warn(code, frame,
       fmt::format("module {}() does not support child modules", code.name));
}

// `$fn $fa $fs`, the last two clamped.
Facets clamped_facets(const BuiltinModuleCode& code, Frame& frame) {
  constexpr double kLeast = 0.01;
  Facets facets = current_facets(frame.in);
  const auto clamp = [&](double& value, const char* name) {
    if (!(value < kLeast)) return;
    warn(code, frame,
         fmt::format("{} too small - clamping to {:f}", name, kLeast));
    value = kLeast;
  };
  clamp(facets.fs, "$fs");
  clamp(facets.fa, "$fa");
  return facets;
}

void make_leaf(decltype(Node::op) op, const BuiltinModuleCode& code,
               Frame& frame) {
  frame.in.make_node(op, code, frame.in.node_mark());
}

// The radius by a diameter, which counts first, or by a radius; undef where
// neither is a number.
Value radius(const Value& d, const Value& r, std::string_view d_name,
             std::string_view r_name, const BuiltinModuleCode& code,
             Frame& frame) {
  if (!d.is_number()) return r.is_number() ? r : Value();
  if (r.is_number()) {
    warn(code, frame,
         fmt::format("Ignoring radius variable '{}' as diameter '{}' is "
                     "defined too.",
                     r_name, d_name));
  }
  return Value(d.as_number() / 2.0);
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

// sphere() and circle().
template <typename Ball>
void ball(const BuiltinModuleCode& code, Frame& frame) {
  enum { kR, kD };
  refuse_children(code, frame);
  const ModuleArguments arguments(code, frame);
  Ball ball;
  ball.facets = clamped_facets(code, frame);
  const Value r = radius(arguments[kD], arguments[kR], "d", "r", code, frame);
  if (r.is_number()) {
    ball.r = r.as_number();
    if (frame.in.options().check_ranges && !is_positive(ball.r)) {
      warn(code, frame, fmt::format("{}(r={})", code.name, to_echo(r)));
    }
  }
  make_leaf(ball, code, frame);
}

// --- 3D ---------------------------------------------------------------------

void cube(const BuiltinModuleCode& code, Frame& frame) {
  enum { kSize, kCenter };
  refuse_children(code, frame);
  const ModuleArguments arguments(code, frame);
  clamped_facets(code, frame);
  Cube cube;
  const Value& size = arguments[kSize];
  if (!size.is_undef()) {
    const bool is_number = size.is_number();
    if (is_number) cube.size = Vec3(size.as_number());
    const bool is_vector =
        size.elements().size() == 3 && read_vec3(size, 0.0, cube.size);
    if (!is_number && !is_vector) {
      warn(code, frame,
           fmt::format("Unable to convert cube(size={}, ...) parameter to a "
                       "number or a vec3 of numbers",
                       to_echo(size)));
    } else if (frame.in.options().check_ranges &&
               !(is_positive(cube.size.x) && is_positive(cube.size.y) &&
                 is_positive(cube.size.z))) {
      warn(code, frame, fmt::format("cube(size={}, ...)", to_echo(size)));
    }
  }
  cube.center = is_set(arguments[kCenter]);
  make_leaf(cube, code, frame);
}

void check_cylinder(const Cylinder& cylinder, const Value& h, const Value& r1,
                    const Value& r2, const BuiltinModuleCode& code,
                    Frame& frame) {
  if (!is_positive(cylinder.h)) {
    warn(code, frame, fmt::format("cylinder(h={}, ...)", to_echo(h)));
  }
  const bool is_fine = cylinder.r1 >= 0 && cylinder.r2 >= 0 &&
                       !(cylinder.r1 == 0 && cylinder.r2 == 0) &&
                       std::isfinite(cylinder.r1) && std::isfinite(cylinder.r2);
  if (!is_fine) {
    warn(code, frame,
         fmt::format("cylinder(r1={}, r2={}, ...)", to_echo(r1), to_echo(r2)));
  }
}

void cylinder(const BuiltinModuleCode& code, Frame& frame) {
  enum { kH, kR1, kR2, kCenter, kR, kD, kD1, kD2 };
  refuse_children(code, frame);
  const ModuleArguments arguments(code, frame);
  Cylinder cylinder;
  cylinder.facets = clamped_facets(code, frame);
  if (arguments[kH].is_number()) cylinder.h = arguments[kH].as_number();
  const Value r = radius(arguments[kD], arguments[kR], "d", "r", code, frame);
  const Value r1 =
      radius(arguments[kD1], arguments[kR1], "d1", "r1", code, frame);
  const Value r2 =
      radius(arguments[kD2], arguments[kR2], "d2", "r2", code, frame);
  if (r.is_number() && (r1.is_number() || r2.is_number())) {
    warn(code, frame, "Cylinder parameters ambiguous");
  }
  if (r.is_number()) cylinder.r1 = cylinder.r2 = r.as_number();
  if (r1.is_number()) cylinder.r1 = r1.as_number();
  if (r2.is_number()) cylinder.r2 = r2.as_number();
  if (frame.in.options().check_ranges) {
    check_cylinder(cylinder, arguments[kH], r1.is_number() ? r1 : r,
                   r2.is_number() ? r2 : r, code, frame);
  }
  cylinder.center = is_set(arguments[kCenter]);
  make_leaf(cylinder, code, frame);
}

// An index of a point. What cannot be one becomes an index out of bounds:
// negative numbers count down from 2³², anything else becomes -1.
std::uint32_t to_index(const Value& value) {
  constexpr double kLimit = std::numeric_limits<std::int32_t>::max();
  const double number = value.number_or_zero();
  const std::int32_t index =
      std::abs(number) < kLimit ? static_cast<std::int32_t>(number) : -1;
  return static_cast<std::uint32_t>(index);
}
bool is_plain_index(const Value& value) {
  return value.is_number() && value.as_number() == to_index(value) &&
         !std::signbit(value.as_number());
}

using IndexLists = std::span<const std::span<const std::uint32_t>>;

// Faces or paths. Sets `is_plain` to false where the indices alone do not show
// what was written.
IndexLists to_index_lists(const Value& value, Interpreter& in, bool& is_plain) {
  std::vector<std::span<const std::uint32_t>> lists;
  if (!value.is_vector()) is_plain = false;
  for (const Value& list : value.elements()) {
    if (!list.is_vector()) is_plain = false;
    std::vector<std::uint32_t> indices;
    for (const Value& index : list.elements()) {
      if (!is_plain_index(index)) is_plain = false;
      indices.push_back(to_index(index));
    }
    lists.push_back(in.keep_all<std::uint32_t>(indices));
  }
  return in.keep_all<std::span<const std::uint32_t>>(lists);
}

// The first index in the lists that is one of these.
std::optional<std::uint32_t> first_named(
    IndexLists lists, const std::set<std::uint32_t>& indices) {
  if (indices.empty()) return std::nullopt;
  for (const auto& list : lists) {
    for (const std::uint32_t index : list) {
      if (indices.contains(index)) return index;
    }
  }
  return std::nullopt;
}

std::string describe_point(const Value& points, std::size_t index) {
  return fmt::format("points[{}] = {}", index,
                     to_echo(points.elements()[index]));
}

int at_least_one(int convexity) { return convexity < 1 ? 1 : convexity; }

void polyhedron(const BuiltinModuleCode& code, Frame& frame) {
  enum { kPoints, kFaces, kConvexity, kTriangles };
  refuse_children(code, frame);
  Interpreter& in = frame.in;
  const ModuleArguments arguments(code, frame);
  clamped_facets(code, frame);
  Value faces = arguments[kFaces];
  if (faces.is_undef() && !arguments[kTriangles].is_undef()) {
    faces = arguments[kTriangles];
    in.deprecate({},
                 "polyhedron(triangles=[]) will be removed in future "
                 "releases. Use polyhedron(faces=[]) instead.");
  }
  PolyhedronParams polyhedron;
  bool is_plain = arguments[kPoints].is_vector();
  std::vector<Vec3> points;
  std::set<std::uint32_t> wrong_points;
  for (const Value& point : arguments[kPoints].elements()) {
    const std::optional<Vec3> given = to_vec3(point, 0.0);
    if (point.elements().size() != 3 || !given) is_plain = false;
    // 0 · x is NaN where x is not finite.
    if (!given || glm::dot(*given, Vec3(0)) != 0) {
      wrong_points.insert(static_cast<std::uint32_t>(points.size()));
    }
    points.push_back(given.value_or(Vec3(0)));
  }
  polyhedron.points = in.keep_all<Vec3>(points);
  polyhedron.faces = to_index_lists(faces, in, is_plain);
  if (const auto wrong = first_named(polyhedron.faces, wrong_points)) {
    polyhedron.wrong_point =
        in.keep_text(describe_point(arguments[kPoints], *wrong));
  }
  polyhedron.convexity = at_least_one(to_int(arguments[kConvexity]));
  if (!is_plain) {
    polyhedron.csg_text =
        in.keep_text("points = " + to_echo(arguments[kPoints]) +
                     ", faces = " + to_echo(faces));
  }
  make_leaf(Polyhedron{in.keep(polyhedron)}, code, frame);
}

// --- 2D ---------------------------------------------------------------------

void square(const BuiltinModuleCode& code, Frame& frame) {
  enum { kSize, kCenter };
  refuse_children(code, frame);
  const ModuleArguments arguments(code, frame);
  clamped_facets(code, frame);
  Square square;
  const Value& size = arguments[kSize];
  if (!size.is_undef()) {
    const bool is_number = size.is_number();
    if (is_number) square.size = Vec2(size.as_number());
    const std::optional<Vec2> given = to_vec2(size);
    if (given) square.size = *given;
    if (!is_number && !given) {
      warn(code, frame,
           fmt::format("Unable to convert square(size={}, ...) parameter to a "
                       "number or a vec2 of numbers",
                       to_echo(size)));
    } else if (frame.in.options().check_ranges &&
               !(is_positive(square.size.x) && is_positive(square.size.y))) {
      warn(code, frame, fmt::format("square(size={}, ...)", to_echo(size)));
    }
  }
  square.center = is_set(arguments[kCenter]);
  make_leaf(square, code, frame);
}

void polygon(const BuiltinModuleCode& code, Frame& frame) {
  enum { kPoints, kPaths, kConvexity };
  refuse_children(code, frame);
  Interpreter& in = frame.in;
  const ModuleArguments arguments(code, frame);
  clamped_facets(code, frame);
  PolygonParams polygon;
  bool is_plain = arguments[kPoints].is_vector();
  std::vector<Vec2> points;
  for (const Value& point : arguments[kPoints].elements()) {
    const std::optional<Vec2> given = to_vec2(point);
    if (!given) is_plain = false;
    const bool is_wrong =
        !given || std::isinf(given->x) || std::isinf(given->y);
    if (is_wrong && polygon.wrong_point.empty()) {
      polygon.wrong_point =
          in.keep_text(describe_point(arguments[kPoints], points.size()));
    }
    points.push_back(given.value_or(Vec2(0)));
  }
  polygon.points = in.keep_all<Vec2>(points);
  const Value& paths = arguments[kPaths];
  if (!paths.elements().empty()) {
    polygon.paths = to_index_lists(paths, in, is_plain);
  } else if (!paths.is_undef()) {
    is_plain = false;
  }
  polygon.convexity = at_least_one(to_int(arguments[kConvexity]));
  if (!is_plain) {
    polygon.csg_text = in.keep_text("points = " + to_echo(arguments[kPoints]) +
                                    ", paths = " + to_echo(paths));
  }
  make_leaf(Polygon{in.keep(polygon)}, code, frame);
}

}  // namespace

std::vector<BuiltinModuleRow> primitive_rows() {
  return {
      {"cube", cube, {"size", "center"}},
      {"sphere", ball<Sphere>, {"r"}, {"d"}},
      {"cylinder",
       cylinder,
       {"h", "r1", "r2", "center"},
       {"r", "d", "d1", "d2"}},
      {"polyhedron",
       polyhedron,
       {"points", "faces", "convexity"},
       {"triangles"}},
      {"square", square, {"size", "center"}},
      {"circle", ball<Circle>, {"r"}, {"d"}},
      {"polygon", polygon, {"points", "paths", "convexity"}},
  };
}

}  // namespace lamina::csg
