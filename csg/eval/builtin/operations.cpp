// Modules that change their children: Booleans, hull and its kin, extrusions,
// offset, projection, color, render.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/letter_case.h"
#include "csg/csg_printer.h"
#include "csg/eval/builtin/colors.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

// --- Booleans ---------------------------------------------------------------

// Runs a module without parameters; 2021.01 does not even evaluate arguments.
template <typename Op>
void plain_operation(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  if (!frame.in.is_2021()) {
    const ModuleCall call(code, frame);
  } else if (!code.arguments.empty()) {
    frame.in.note_difference(code.range, "arguments of a Boolean");
  }
  run_block(*code.block, frame);
  frame.in.make_node(Op{}, code, mark);
}

// --- color, render ----------------------------------------------------------

Color color(const ModuleCall& call) {
  // OpenSCAD keeps colors in single precision; -1 stands for "none".
  const bool is_2021 = call.in.language() == Language::k2021;
  std::array<float, 4> rgba = {-1, -1, -1, is_2021 ? 1.0F : -1.0F};
  const Value& given = call["c"];
  if (given.is_vector()) {
    const std::span<const Value> parts = given.as_vector();
    for (std::size_t i = 0; i < 4; ++i) {
      rgba[i] = i < parts.size() ? static_cast<float>(parts[i].number_or_zero())
                                 : 1.0F;
      if (rgba[i] > 1 || rgba[i] < 0) {
        call.warn(
            "color() expects numbers between 0.0 and 1.0. Value of {:.1f} is "
            "out of range",
            rgba[i]);
      }
    }
  } else if (given.is_string()) {
    const std::string name = lower_case(given.as_string());
    if (const auto found = find_color(name)) {
      rgba = *found;
    } else {
      call.warn("Unable to parse color \"{}\"",
                is_2021 ? name : given.as_string());
      if (is_2021) {
        call.in.note("Please see https://en.wikipedia.org/wiki/Web_colors");
      }
    }
  }
  if (call["alpha"].is_number()) {
    rgba[3] = static_cast<float>(call["alpha"].as_number());
    if (!is_2021 && (rgba[3] < 0 || rgba[3] > 1)) {
      call.warn(
          "color() expects alpha between 0.0 and 1.0. Value of {:.1f} is out "
          "of range",
          rgba[3]);
    }
  }
  return {Vec4(rgba[0], rgba[1], rgba[2], rgba[3])};
}

Render render(const ModuleCall& call) {
  const Value& convexity = call["convexity"];
  return {convexity.is_number() ? to_int(convexity) : 1};
}

// --- hull, fill, minkowski, resize ------------------------------------------

template <typename Outline>
Outline outline(const ModuleCall&) {
  return {};
}

Minkowski minkowski(const ModuleCall& call) {
  return {to_int(call["convexity"])};
}

Resize resize(const ModuleCall& call) {
  Resize resize{Vec3(0.0), {}, to_int(call["convexity"])};
  const std::span<const Value> sizes = call["newsize"].elements();
  for (std::size_t i = 0; i < std::min<std::size_t>(sizes.size(), 3); ++i) {
    resize.new_size[static_cast<int>(i)] = sizes[i].number_or_zero();
  }
  const Value& automatic = call["auto"];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::span<const Value> flags = automatic.elements();
    if (i < flags.size()) resize.auto_size[i] = flags[i].is_true();
    if (automatic.is_bool()) resize.auto_size[i] = automatic.as_bool();
  }
  return resize;
}

// --- From 2D to 3D and back -------------------------------------------------

Projection projection(const ModuleCall& call) {
  return {is_set(call["cut"]), to_int(call["convexity"])};
}

Offset offset(const ModuleCall& call) {
  Offset offset;
  offset.facets = facets_of(call);
  offset.amount = 1;
  if (call["r"].is_number()) {
    if (call["delta"].is_number() && !call.in.is_2021()) {
      call.warn("Ignoring \"delta\" argument as \"r\" is defined too.");
    }
    offset.amount = call["r"].as_number();
  } else if (call["delta"].is_number()) {
    offset.amount = call["delta"].as_number();
    offset.is_delta = true;
    offset.chamfer = is_set(call["chamfer"]);
  }
  return offset;
}

Roof roof(const ModuleCall& call) {
  Roof roof;
  roof.facets = facets_of(call);
  if (const Value& method = call["method"]; !method.is_undef()) {
    const std::string name = to_text(method);
    roof.is_straight = name == "straight";
    if (name != "straight" && name != "voronoi") {
      call.warn("Unknown roof method '{}'. Using 'voronoi'.", name);
    }
  }
  if (to_finite(call["convexity"])) {
    roof.convexity = std::max(to_int(call["convexity"]), 1);
  }
  return roof;
}

// The value of a parameter that has two names.
const Value& either(std::string_view name, std::string_view other,
                    const ModuleCall& call) {
  if (call[name].is_undef()) return call[other];
  if (!call[other].is_undef()) {
    call.warn("Specified both {} and {}",
              quoted_name(name, call.in.language(), "\""),
              quoted_name(other, call.in.language(), "\""));
  }
  return call[name];
}

// The way from the bottom of an extrusion to its top: a height, or a vector.
Vec3 read_extrusion_way(const ModuleCall& call) {
  constexpr double kUsualHeight = 100;
  Vec3 way(0, 0, 1);
  if (!call["v"].is_undef()) {
    const std::optional<Vec3> given = to_vec3(call["v"]);
    if (given && std::isfinite(glm::dot(*given, *given))) {
      way = *given;
    } else {
      call.warn("v when specified should be a 3d vector");
    }
  }
  Value height = either("height", "h", call);
  if (height.is_undef() && call.code.late_argument != nullptr) {
    height = run(call.code.late_argument, call.frame);
  }
  if (height.is_undef()) return call["v"].is_undef() ? way * kUsualHeight : way;
  const std::optional<double> number = to_finite(height);
  if (!number && !call.in.is_2021()) {
    call.warn("height when specified should be a number");
  }
  const double length = glm::length(way);
  return way * (number.value_or(kUsualHeight) / (length > 0 ? length : 1));
}

// A whole number, `least` or more; none where it is not a number.
std::optional<int> read_count(std::string_view name, int least,
                              const ModuleCall& call) {
  const Value& value = call[name];
  if (to_finite(value)) return std::max(to_int(value), least);
  if (value.is_undef() || call.in.is_2021()) return std::nullopt;
  if (value.is_number()) {
    call.warn("{}(..., {}={}) argument cannot be infinite or nan",
              call.code.name, name, to_echo(value));
  } else {
    call.warn("{}(..., {}={}) Invalid type: expected number, found {}",
              call.code.name, name, to_echo(value), type_name(value.type()));
  }
  return std::nullopt;
}

// The scale of the top. 2021.01 warns of it where the origin is given.
Vec2 read_extrusion_scale(const Value& scale, const Value& origin,
                          const ModuleCall& call) {
  Vec2 factors(1.0);
  bool is_fine = true;
  if (const std::optional<double> number = to_finite(scale)) {
    factors = Vec2(*number);
  } else if (const std::optional<Vec2> pair = to_vec2(scale);
             pair && std::isfinite(pair->x) && std::isfinite(pair->y)) {
    factors = *pair;
  } else {
    is_fine = false;
  }
  const Value& asked = call.in.is_2021() ? origin : scale;
  if (!asked.is_undef() && !is_fine) {
    call.warn("linear_extrude(..., scale={}) could not be converted",
              to_echo(scale));
  }
  return Vec2(std::max(factors.x, 0.0), std::max(factors.y, 0.0));
}

// What the deprecated file= stands for: a drawing to extrude.
ImportParams import_drawing(const Value& file, const Value& layer, Vec2 origin,
                            double scale, const ModuleCall& call) {
  ImportParams params;
  params.path = call.in.keep_text(find_file(to_text(file), call));
  params.format = ImportFormat::kDxf;
  params.layer = call.in.keep_text(layer.is_undef() ? "" : to_text(layer));
  params.origin = origin;
  params.scale = scale;
  params.facets = current_facets(call.in);
  return params;
}

// Puts the drawing below the extrusion that comes next, whose `.csg` text
// identifies it. Returns that text, kept.
std::string_view make_drawing(ImportParams drawing, std::string_view csg_text,
                              const ModuleCall& call) {
  Interpreter& in = call.in;
  drawing.csg_text = in.keep_text(csg_text);
  in.make_node(Import{in.keep(drawing)}, call.code, in.node_mark());
  return drawing.csg_text;
}

void deprecate_file(std::string_view module, const ModuleCall& call) {
  call.in.deprecate(
      {}, fmt::format("Support for reading files in {} will be removed in "
                      "future releases. Use a child import() instead.",
                      module));
}

void linear_extrude(const BuiltinModuleCode& code, Frame& frame) {
  Interpreter& in = frame.in;
  const std::size_t mark = in.node_mark();
  const ModuleCall call(code, frame);
  begin_block(*code.block, frame);
  LinearExtrudeParams params;
  params.facets = facets_of(call);
  const Value& file = call["file"];
  if (file.is_string()) deprecate_file("linear_extrude", call);
  const Vec3 way = read_extrusion_way(call);
  params.shift = Vec2(way);
  params.height = way.z > 0 ? way.z : 0;  // -0 is printed otherwise
  params.convexity =
      std::max(to_finite(call["convexity"]) ? to_int(call["convexity"]) : 1, 1);
  const Vec2 origin = read_origin(call["origin"], "linear_extrude", call);
  params.scale = read_extrusion_scale(call["scale"], call["origin"], call);
  params.center = is_set(call["center"]);
  params.slices = read_count("slices", in.is_2021() ? 0 : 1, call).value_or(0);
  params.segments = read_count("segments", 0, call);
  params.twist_deg = to_finite(call["twist"]).value_or(0.0);
  params.has_twist = params.twist_deg != 0.0;
  if (file.is_string() && !file.as_string().empty()) {
    const ImportParams drawing =
        import_drawing(file, call["layer"], origin, params.scale.x, call);
    std::string text =
        fmt::format("linear_extrude({}{}, ", drawing_text(drawing, frame),
                    timestamp_text(std::string(drawing.path), frame));
    append_linear_extrude(params, in.language(), text);
    params.csg_text = make_drawing(drawing, text + ")", call);
  } else {
    end_block(*code.block, frame);
  }
  in.make_node(LinearExtrude{in.keep(params)}, code, mark);
}

// OpenSCAD 2021.01 begins full turns at -x, 2026 those of which no angle is
// given; all others at +x.
void read_turn(const ModuleCall& call, RotateExtrude& extrude) {
  const std::optional<double> angle = to_finite(either("angle", "a", call));
  extrude.angle_deg = angle.value_or(360.0);
  if (extrude.angle_deg <= -360 || extrude.angle_deg > 360) {
    extrude.angle_deg = 360;
  }
  const bool begins_behind =
      call.in.is_2021() ? extrude.angle_deg == 360 : !angle;
  extrude.start_deg =
      to_finite(call["start"]).value_or(begins_behind ? 180 : 0);
}

void rotate_extrude(const BuiltinModuleCode& code, Frame& frame) {
  Interpreter& in = frame.in;
  const std::size_t mark = in.node_mark();
  const ModuleCall call(code, frame);
  begin_block(*code.block, frame);
  RotateExtrude extrude;
  extrude.facets = facets_of(call);
  const Value& file = call["file"];
  if (!file.is_undef()) deprecate_file("rotate_extrude", call);
  extrude.convexity = to_int(call["convexity"]);
  if (extrude.convexity <= (in.is_2021() ? 0 : 1)) extrude.convexity = 2;
  const Vec2 origin = read_origin(call["origin"], "rotate_extrude", call);
  read_turn(call, extrude);
  if (!file.is_undef() && !to_text(file).empty()) {
    const double given = call["scale"].number_or_zero();
    const double scale = given <= 0 ? 1 : given;
    const ImportParams drawing =
        import_drawing(file, call["layer"], origin, scale, call);
    std::string text = fmt::format(
        "rotate_extrude({}scale = {:g}, {}, ", drawing_text(drawing, frame),
        scale, timestamp_text(std::string(drawing.path), frame));
    append_rotate_extrude(extrude, in.language(), text);
    extrude.csg_text = make_drawing(drawing, text + ")", call);
  } else {
    end_block(*code.block, frame);
  }
  in.make_node(extrude, code, mark);
}

// A module that 2021.01 lacks.
template <BuiltinModule module>
void newer(const BuiltinModuleCode& code, Frame& frame) {
  frame.in.note_newer(code.range, code.name);
  module(code, frame);
}

}  // namespace

std::vector<BuiltinModuleRow> operation_rows() {
  const std::vector<std::string_view> linear = {"file",   "layer", "height",
                                                "origin", "scale", "center",
                                                "twist",  "slices"};
  const std::vector<std::string_view> newer_linear = {
      "height", "v",        "scale",     "center", "twist",
      "slices", "segments", "convexity", "h"};
  const std::vector<std::string_view> around = {"file", "layer", "origin",
                                                "scale"};
  const std::vector<std::string_view> newer_around = {"angle", "start",
                                                      "convexity", "a"};
  return {
      {"group", plain_operation<Group>, {}},
      {"union", plain_operation<Union>, {}},
      {"difference", plain_operation<Difference>, {}},
      {"intersection", plain_operation<Intersection>, {}},
      {"color", run_operation<color>, {"c", "alpha"}},
      {"render", run_operation<render>, {"convexity"}},
      {"hull", run_operation<outline<Hull>>, {}},
      {"fill", newer<run_operation<outline<Fill>>>, {}},
      {"minkowski", run_operation<minkowski>, {"convexity"}},
      {"resize", run_operation<resize>, {"newsize", "auto", "convexity"}},
      {"projection", run_operation<projection>, {"cut"}, {"convexity"}},
      {"roof", newer<run_operation<roof>>, {"method"}, {"convexity"}},
      {"offset", run_operation<offset>, {"r"}, {"delta", "chamfer"}},
      {"linear_extrude",
       linear_extrude,
       linear,
       {"convexity"},
       {},
       newer_linear},
      {"dxf_linear_extrude",
       linear_extrude,
       linear,
       {"convexity"},
       "linear_extrude()",
       newer_linear},
      {"rotate_extrude",
       rotate_extrude,
       around,
       {"convexity", "angle"},
       {},
       newer_around},
      {"dxf_rotate_extrude",
       rotate_extrude,
       around,
       {"convexity", "angle"},
       "rotate_extrude()",
       newer_around},
  };
}

}  // namespace lamina::csg
