// Modules that change their children: Booleans, hull and its kin, extrusions,
// offset, projection, color, render.

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/letter_case.h"
#include "csg/csg_printer.h"
#include "csg/eval/builtin/colors.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

// --- Booleans ---------------------------------------------------------------

// Runs a module that does not even evaluate its arguments.
template <typename Op>
void plain_operation(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  run_block(*code.block, frame);
  frame.in.make_node(Op{}, code, mark);
}

// --- color, render ----------------------------------------------------------

void color(const BuiltinModuleCode& code, Frame& frame) {
  enum { kColor, kAlpha };
  Interpreter& in = frame.in;
  const std::size_t mark = in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_assignments(*code.block, frame);
  // OpenSCAD keeps colors in single precision; -1 stands for "none".
  float rgba[4] = {-1, -1, -1, 1};
  const Value& given = arguments[kColor];
  if (given.is_vector()) {
    const std::span<const Value> parts = given.as_vector();
    for (std::size_t i = 0; i < 4; ++i) {
      rgba[i] = i < parts.size() ? static_cast<float>(parts[i].number_or_zero())
                                 : 1.0F;
      if (rgba[i] > 1 || rgba[i] < 0) {
        warn(code, frame,
             fmt::format("color() expects numbers between 0.0 and 1.0. Value "
                         "of {:.1f} is out of range",
                         rgba[i]));
      }
    }
  } else if (given.is_string()) {
    const std::string name = lower_case(given.as_string());
    if (const auto found = find_color(name)) {
      std::copy(found->begin(), found->end(), rgba);
    } else {
      warn(code, frame, fmt::format("Unable to parse color \"{}\"", name));
      in.note("Please see https://en.wikipedia.org/wiki/Web_colors");
    }
  }
  if (arguments[kAlpha].is_number()) {
    rgba[3] = static_cast<float>(arguments[kAlpha].as_number());
  }
  run_statements(*code.block, frame);
  in.make_node(Color{Vec4(rgba[0], rgba[1], rgba[2], rgba[3])}, code, mark);
}

void render(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_block(*code.block, frame);
  Render render;
  render.convexity = arguments[0].is_number() ? to_int(arguments[0]) : 1;
  frame.in.make_node(render, code, mark);
}

// --- hull, fill, minkowski, resize ------------------------------------------

template <typename Op>
void outline_operation(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_block(*code.block, frame);
  frame.in.make_node(Op{}, code, mark);
}

void minkowski(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_block(*code.block, frame);
  frame.in.make_node(Minkowski{to_int(arguments[0])}, code, mark);
}

void resize(const BuiltinModuleCode& code, Frame& frame) {
  enum { kNewSize, kAuto, kConvexity };
  const std::size_t mark = frame.in.node_mark();
  const ModuleArguments arguments(code, frame);
  Resize resize{Vec3(0.0), {}, to_int(arguments[kConvexity])};
  const std::span<const Value> sizes = arguments[kNewSize].elements();
  for (std::size_t i = 0; i < std::min<std::size_t>(sizes.size(), 3); ++i) {
    resize.new_size[static_cast<int>(i)] = sizes[i].number_or_zero();
  }
  const Value& automatic = arguments[kAuto];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::span<const Value> flags = automatic.elements();
    if (i < flags.size()) resize.auto_size[i] = flags[i].is_true();
    if (automatic.is_bool()) resize.auto_size[i] = automatic.as_bool();
  }
  run_block(*code.block, frame);
  frame.in.make_node(resize, code, mark);
}

// --- From 2D to 3D and back -------------------------------------------------

void projection(const BuiltinModuleCode& code, Frame& frame) {
  enum { kCut, kConvexity };
  const std::size_t mark = frame.in.node_mark();
  const ModuleArguments arguments(code, frame);
  Projection projection;
  projection.cut = is_set(arguments[kCut]);
  projection.convexity = to_int(arguments[kConvexity]);
  run_block(*code.block, frame);
  frame.in.make_node(projection, code, mark);
}

void offset(const BuiltinModuleCode& code, Frame& frame) {
  enum { kR, kDelta, kChamfer };
  const std::size_t mark = frame.in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_assignments(*code.block, frame);
  Offset offset;
  offset.facets = current_facets(frame.in);
  offset.amount = 1;
  if (arguments[kR].is_number()) {
    offset.amount = arguments[kR].as_number();
  } else if (arguments[kDelta].is_number()) {
    offset.amount = arguments[kDelta].as_number();
    offset.is_delta = true;
    offset.chamfer = is_set(arguments[kChamfer]);
  }
  run_statements(*code.block, frame);
  frame.in.make_node(offset, code, mark);
}

// The deprecated scale= of extrusions.
Vec2 read_extrusion_scale(const Value& scale, const Value& origin,
                          const BuiltinModuleCode& code, Frame& frame) {
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
  // OpenSCAD asks for the origin here, not for the scale.
  if (!origin.is_undef() && !is_fine) {
    warn(code, frame,
         fmt::format("linear_extrude(..., scale={}) could not be converted",
                     to_echo(scale)));
  }
  return Vec2(std::max(factors.x, 0.0), std::max(factors.y, 0.0));
}

// Makes the node that the deprecated file= stands for: a drawing to extrude.
ImportParams import_drawing(const Value& file, const Value& layer, Vec2 origin,
                            double scale, const BuiltinModuleCode& code,
                            Frame& frame) {
  Interpreter& in = frame.in;
  ImportParams params;
  params.path = in.keep_text(find_file(to_text(file), code, frame));
  params.format = ImportFormat::kDxf;
  params.layer = in.keep_text(layer.is_undef() ? "" : to_text(layer));
  params.origin = origin;
  params.scale = scale;
  params.facets = current_facets(in);
  return params;
}

// Puts the drawing below the extrusion that comes next. The extrusion's text
// identifies it.
void make_drawing(ImportParams drawing, std::string_view csg_text,
                  const BuiltinModuleCode& code, Frame& frame) {
  Interpreter& in = frame.in;
  drawing.csg_text = csg_text;
  in.make_node(Import{in.keep(drawing)}, code, in.node_mark());
}

void linear_extrude(const BuiltinModuleCode& code, Frame& frame) {
  enum {
    kFile,
    kLayer,
    kHeight,
    kOrigin,
    kScale,
    kCenter,
    kTwist,
    kSlices,
    kConvexity
  };
  Interpreter& in = frame.in;
  const std::size_t mark = in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_assignments(*code.block, frame);
  LinearExtrudeParams params;
  params.facets = current_facets(in);
  const Value& file = arguments[kFile];
  if (file.is_string()) {
    in.deprecate({},
                 "Support for reading files in linear_extrude will be removed "
                 "in future releases. Use a child import() instead.");
  }
  if (!arguments[kHeight].is_undef()) {
    params.height = to_finite(arguments[kHeight]).value_or(params.height);
  } else if (code.late_argument != nullptr) {
    const Value height = run(code.late_argument, frame);
    params.height = to_finite(height).value_or(params.height);
  }
  if (params.height <= 0) params.height = 0;  // -0 is printed otherwise
  params.convexity = std::max(
      to_finite(arguments[kConvexity]) ? to_int(arguments[kConvexity]) : 1, 1);
  const Vec2 origin =
      read_origin(arguments[kOrigin], "linear_extrude", code, frame);
  params.scale =
      read_extrusion_scale(arguments[kScale], arguments[kOrigin], code, frame);
  params.center = is_set(arguments[kCenter]);
  if (to_finite(arguments[kSlices])) {
    params.slices = std::max(to_int(arguments[kSlices]), 0);
  }
  params.twist_deg = to_finite(arguments[kTwist]).value_or(0.0);
  params.has_twist = params.twist_deg != 0.0;
  if (file.is_string() && !file.as_string().empty()) {
    const ImportParams drawing = import_drawing(file, arguments[kLayer], origin,
                                                params.scale.x, code, frame);
    std::string text = "linear_extrude(" + drawing_text(drawing, frame);
    text += timestamp_text(std::string(drawing.path), frame) + ", ";
    append_linear_extrude(params, text);
    params.csg_text = in.keep_text(text + ")");
    make_drawing(drawing, params.csg_text, code, frame);
  } else {
    run_statements(*code.block, frame);
  }
  in.make_node(LinearExtrude{in.keep(params)}, code, mark);
}

void rotate_extrude(const BuiltinModuleCode& code, Frame& frame) {
  enum { kFile, kLayer, kOrigin, kScale, kConvexity, kAngle };
  Interpreter& in = frame.in;
  const std::size_t mark = in.node_mark();
  const ModuleArguments arguments(code, frame);
  run_assignments(*code.block, frame);
  RotateExtrude extrude;
  extrude.facets = current_facets(in);
  const Value& file = arguments[kFile];
  if (!file.is_undef()) {
    in.deprecate({},
                 "Support for reading files in rotate_extrude will be removed "
                 "in future releases. Use a child import() instead.");
  }
  extrude.convexity = to_int(arguments[kConvexity]);
  if (extrude.convexity <= 0) extrude.convexity = 2;
  const Vec2 origin =
      read_origin(arguments[kOrigin], "rotate_extrude", code, frame);
  extrude.angle_deg = to_finite(arguments[kAngle]).value_or(360.0);
  if (extrude.angle_deg <= -360 || extrude.angle_deg > 360) {
    extrude.angle_deg = 360;
  }
  if (!file.is_undef() && !to_text(file).empty()) {
    const double given = arguments[kScale].number_or_zero();
    const double scale = given <= 0 ? 1 : given;
    const ImportParams drawing =
        import_drawing(file, arguments[kLayer], origin, scale, code, frame);
    std::string text = "rotate_extrude(" + drawing_text(drawing, frame);
    text += "scale = ";
    append_stream_number(scale, text);
    text += ", " + timestamp_text(std::string(drawing.path), frame) + ", ";
    append_rotate_extrude(extrude, text);
    extrude.csg_text = in.keep_text(text + ")");
    make_drawing(drawing, extrude.csg_text, code, frame);
  } else {
    run_statements(*code.block, frame);
  }
  in.make_node(extrude, code, mark);
}

}  // namespace

std::vector<BuiltinModuleRow> operation_rows() {
  return {
      {"group", plain_operation<Group>, {}},
      {"union", plain_operation<Union>, {}},
      {"difference", plain_operation<Difference>, {}},
      {"intersection", plain_operation<Intersection>, {}},
      {"color", color, {"c", "alpha"}},
      {"render", render, {"convexity"}},
      {"hull", outline_operation<Hull>, {}},
      {"fill", outline_operation<Fill>, {}},
      {"minkowski", minkowski, {"convexity"}},
      {"resize", resize, {"newsize", "auto", "convexity"}},
      {"projection", projection, {"cut"}, {"convexity"}},
      {"offset", offset, {"r"}, {"delta", "chamfer"}},
      {"linear_extrude",
       linear_extrude,
       {"file", "layer", "height", "origin", "scale", "center", "twist",
        "slices"},
       {"convexity"}},
      {"dxf_linear_extrude",
       linear_extrude,
       {"file", "layer", "height", "origin", "scale", "center", "twist",
        "slices"},
       {"convexity"},
       "linear_extrude()"},
      {"rotate_extrude",
       rotate_extrude,
       {"file", "layer", "origin", "scale"},
       {"convexity", "angle"}},
      {"dxf_rotate_extrude",
       rotate_extrude,
       {"file", "layer", "origin", "scale"},
       {"convexity", "angle"},
       "rotate_extrude()"},
  };
}

}  // namespace lamina::csg
