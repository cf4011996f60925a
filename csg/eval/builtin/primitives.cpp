// cube, sphere, cylinder, polyhedron, square, circle, polygon.

#include <algorithm>
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
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

// Runs a module without children; `make` makes the leaf of the call.
template <auto make>
void run_primitive(const BuiltinModuleCode& code, Frame& frame) {
  warn_of_children(code, frame);
  const ModuleCall call(code, frame);
  const Facets facets = clamped_facets(call);
  frame.in.make_node(make(call, facets), code, frame.in.node_mark());
}

// The radius by a diameter, which counts first, or by a radius; undef where
// neither is a number.
Value radius(const Value& d, const Value& r, std::string_view d_name,
             std::string_view r_name, const ModuleCall& call) {
  if (!d.is_number()) return r.is_number() ? r : Value();
  if (r.is_number()) {
    const Language language = call.in.language();
    call.warn("Ignoring radius variable {} as diameter {} is defined too.",
              quoted_name(r_name, language, "'"),
              quoted_name(d_name, language, "'"));
  }
  return Value(d.as_number() / 2.0);
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

// sphere() and circle().
template <typename Ball>
Ball ball(const ModuleCall& call, const Facets& facets) {
  Ball ball;
  ball.facets = facets;
  const Value r = radius(call["d"], call["r"], "d", "r", call);
  if (r.is_number()) {
    ball.r = r.as_number();
    if (call.in.options().check_ranges && !is_positive(ball.r)) {
      call.warn("{}(r={})", call.code.name, to_echo(r));
    }
  }
  return ball;
}

// --- Points, faces and paths -------------------------------------------------
// As OpenSCAD 2026 reads them: what is wrong is warned of where the module is
// called, and left out.

// Returns the points of the call, a wrong one as the origin; nothing where
// `points` is not a vector.
//
// convert  makes a point of a value, or none
template <typename Point, typename Convert>
std::optional<std::vector<Point>> read_points(const ModuleCall& call,
                                              std::string_view type,
                                              const Convert& convert) {
  const Value& given = call["points"];
  if (!given.is_vector()) {
    call.warn("Unable to convert points = {} to a vector of coordinates",
              to_echo(given));
    return std::nullopt;
  }
  std::vector<Point> points;
  for (const Value& value : given.as_vector()) {
    std::optional<Point> point = convert(value);
    // 0 · x is NaN where x is not finite.
    if (!point || glm::dot(*point, Point(0)) != 0) {
      call.warn("Unable to convert points[{}] = {} to a {} of numbers",
                points.size(), to_echo(value), type);
      point = Point(0);
    }
    points.push_back(*point);
  }
  return points;
}

using IndexLists = std::span<const std::span<const std::uint32_t>>;

// Returns a parameter's lists of indices of points, kept by the interpreter;
// nothing where it is not a vector.
//
// points  how many there are
// least   lists of fewer indices are left out
std::optional<IndexLists> read_index_lists(std::string_view parameter,
                                           std::size_t points,
                                           std::size_t least,
                                           const ModuleCall& call) {
  const Value& given = call[parameter];
  if (!given.is_vector()) {
    call.warn(
        "Unable to convert {} = {} to a vector of vector of point indices",
        parameter, to_echo(given));
    return std::nullopt;
  }
  std::vector<std::span<const std::uint32_t>> lists;
  const std::span<const Value> values = given.as_vector();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i].is_vector()) {
      call.warn("Unable to convert {}[{}] = {} to a vector of numbers",
                parameter, i, to_echo(values[i]));
      continue;
    }
    std::vector<std::uint32_t> indices;
    const std::span<const Value> list = values[i].as_vector();
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!list[k].is_number()) {
        call.warn("Unable to convert {}[{}][{}] = {} to a number", parameter, i,
                  k, to_echo(list[k]));
        continue;
      }
      const double index = std::trunc(list[k].as_number());
      if (index >= 0 && index < static_cast<double>(points)) {
        indices.push_back(static_cast<std::uint32_t>(index));
      } else {
        call.warn("Point index {:.0f} is out of bounds (from {}[{}][{}])",
                  index, parameter, i, k);
      }
    }
    if (indices.size() >= least) {
      lists.push_back(call.in.keep_all<std::uint32_t>(indices));
    }
  }
  return call.in.keep_all<std::span<const std::uint32_t>>(lists);
}

// --- 3D ---------------------------------------------------------------------

Cube cube(const ModuleCall& call, const Facets&) {
  Cube cube;
  const Value& size = call["size"];
  if (!size.is_undef()) {
    const bool is_number = size.is_number();
    if (is_number) cube.size = Vec3(size.as_number());
    const bool is_vector =
        size.elements().size() == 3 && read_vec3(size, 0.0, cube.size);
    if (!is_number && !is_vector) {
      call.warn(
          "Unable to convert cube(size={}, ...) parameter to a number or a "
          "vec3 of numbers",
          to_echo(size));
    } else if (call.in.options().check_ranges &&
               !(is_positive(cube.size.x) && is_positive(cube.size.y) &&
                 is_positive(cube.size.z))) {
      call.warn("cube(size={}, ...)", to_echo(size));
    }
  }
  cube.center = is_set(call["center"]);
  return cube;
}

void check_cylinder(const Cylinder& cylinder, const Value& h, const Value& r1,
                    const Value& r2, const ModuleCall& call) {
  if (!is_positive(cylinder.h)) {
    call.warn("cylinder(h={}, ...)", to_echo(h));
  }
  const bool is_fine = cylinder.r1 >= 0 && cylinder.r2 >= 0 &&
                       !(cylinder.r1 == 0 && cylinder.r2 == 0) &&
                       std::isfinite(cylinder.r1) && std::isfinite(cylinder.r2);
  if (!is_fine) {
    call.warn("cylinder(r1={}, r2={}, ...)", to_echo(r1), to_echo(r2));
  }
}

Cylinder cylinder(const ModuleCall& call, const Facets& facets) {
  Cylinder cylinder;
  cylinder.facets = facets;
  cylinder.h = number_or(call["h"], cylinder.h);
  const Value r = radius(call["d"], call["r"], "d", "r", call);
  const Value r1 = radius(call["d1"], call["r1"], "d1", "r1", call);
  const Value r2 = radius(call["d2"], call["r2"], "d2", "r2", call);
  if (r.is_number() && (r1.is_number() || r2.is_number())) {
    call.warn("Cylinder parameters ambiguous");
  }
  const Value& bottom = r1.is_number() ? r1 : r;
  const Value& top = r2.is_number() ? r2 : r;
  cylinder.r1 = number_or(bottom, cylinder.r1);
  cylinder.r2 = number_or(top, cylinder.r2);
  if (call.in.options().check_ranges) {
    check_cylinder(cylinder, call["h"], bottom, top, call);
  }
  cylinder.center = is_set(call["center"]);
  return cylinder;
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

Polyhedron polyhedron_2026(const ModuleCall& call) {
  PolyhedronParams polyhedron;
  const auto points = read_points<Vec3>(
      call, "vec3", [](const Value& value) { return to_vec3(value, 0.0); });
  if (points) {
    polyhedron.points = call.in.keep_all<Vec3>(*points);
    if (const auto faces = read_index_lists("faces", points->size(), 3, call)) {
      polyhedron.faces = *faces;
    }
  }
  polyhedron.convexity = std::max(to_int(call["convexity"]), 1);
  return {call.in.keep(polyhedron)};
}

Polyhedron polyhedron(const ModuleCall& call, const Facets&) {
  if (!call.in.is_2021()) return polyhedron_2026(call);
  Interpreter& in = call.in;
  Value faces = call["faces"];
  if (faces.is_undef() && !call["triangles"].is_undef()) {
    faces = call["triangles"];
    in.deprecate({},
                 "polyhedron(triangles=[]) will be removed in future releases. "
                 "Use polyhedron(faces=[]) instead.");
  }
  PolyhedronParams polyhedron;
  bool is_plain = call["points"].is_vector();
  std::vector<Vec3> points;
  std::set<std::uint32_t> wrong_points;
  for (const Value& point : call["points"].elements()) {
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
        in.keep_text(describe_point(call["points"], *wrong));
  }
  polyhedron.convexity = std::max(to_int(call["convexity"]), 1);
  if (!is_plain) {
    polyhedron.csg_text = in.keep_text("points = " + to_echo(call["points"]) +
                                       ", faces = " + to_echo(faces));
  }
  return {in.keep(polyhedron)};
}

// --- 2D ---------------------------------------------------------------------

Square square(const ModuleCall& call, const Facets&) {
  Square square;
  const Value& size = call["size"];
  if (!size.is_undef()) {
    const bool is_number = size.is_number();
    if (is_number) square.size = Vec2(size.as_number());
    const std::optional<Vec2> given = to_vec2(size);
    if (given) square.size = *given;
    if (!is_number && !given) {
      call.warn(
          "Unable to convert square(size={}, ...) parameter to a number or a "
          "vec2 of numbers",
          to_echo(size));
    } else if (call.in.options().check_ranges &&
               !(is_positive(square.size.x) && is_positive(square.size.y))) {
      call.warn("square(size={}, ...)", to_echo(size));
    }
  }
  square.center = is_set(call["center"]);
  return square;
}

Polygon polygon_2026(const ModuleCall& call) {
  PolygonParams polygon;
  const auto points = read_points<Vec2>(call, "vec2", to_vec2);
  if (points) {
    polygon.points = call.in.keep_all<Vec2>(*points);
    if (!call["paths"].is_undef()) {
      const auto paths = read_index_lists("paths", points->size(), 0, call);
      if (paths && !paths->empty()) polygon.paths = *paths;
    }
  }
  polygon.convexity = std::max(to_int(call["convexity"]), 1);
  return {call.in.keep(polygon)};
}

Polygon polygon(const ModuleCall& call, const Facets&) {
  if (!call.in.is_2021()) return polygon_2026(call);
  Interpreter& in = call.in;
  PolygonParams polygon;
  bool is_plain = call["points"].is_vector();
  std::vector<Vec2> points;
  for (const Value& point : call["points"].elements()) {
    const std::optional<Vec2> given = to_vec2(point);
    if (!given) is_plain = false;
    const bool is_wrong =
        !given || std::isinf(given->x) || std::isinf(given->y);
    if (is_wrong && polygon.wrong_point.empty()) {
      polygon.wrong_point =
          in.keep_text(describe_point(call["points"], points.size()));
    }
    points.push_back(given.value_or(Vec2(0)));
  }
  polygon.points = in.keep_all<Vec2>(points);
  const Value& paths = call["paths"];
  if (!paths.elements().empty()) {
    polygon.paths = to_index_lists(paths, in, is_plain);
  } else if (!paths.is_undef()) {
    is_plain = false;
  }
  polygon.convexity = std::max(to_int(call["convexity"]), 1);
  if (!is_plain) {
    polygon.csg_text = in.keep_text("points = " + to_echo(call["points"]) +
                                    ", paths = " + to_echo(paths));
  }
  return {in.keep(polygon)};
}

}  // namespace

std::vector<BuiltinModuleRow> primitive_rows() {
  return {
      {"cube", run_primitive<cube>, {"size", "center"}},
      {"sphere", run_primitive<ball<Sphere>>, {"r"}, {"d"}},
      {"cylinder",
       run_primitive<cylinder>,
       {"h", "r1", "r2", "center"},
       {"r", "d", "d1", "d2"}},
      {"polyhedron",
       run_primitive<polyhedron>,
       {"points", "faces", "convexity"},
       {"triangles"},
       {},
       {"points", "faces", "convexity"}},
      {"square", run_primitive<square>, {"size", "center"}},
      {"circle", run_primitive<ball<Circle>>, {"r"}, {"d"}},
      {"polygon", run_primitive<polygon>, {"points", "paths", "convexity"}},
  };
}

}  // namespace lamina::csg
