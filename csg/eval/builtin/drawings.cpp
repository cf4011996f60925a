// dxf_dim() and dxf_cross() (see functions.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file/file_access.h"
#include "base/file/format_error.h"
#include "csg/degrees.h"
#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/value/text.h"
#include "csg/import/dxf.h"

namespace lamina::csg {

namespace {

namespace fs = std::filesystem;

struct Query {
  std::string written_file;
  std::string path;
  std::string layer;
  std::string name;
  Vec2 origin = Vec2(0.0);
  double scale = 1;
};

std::string folder_of(const Frame& frame) {
  if (frame.document == nullptr) return frame.in.design_folder();
  return fs::absolute(frame.document->path()).parent_path().string();
}

enum class Kind : std::uint8_t { kDim, kCross };

// In the order in which 2026 takes arguments without a name.
std::vector<std::string_view> parameters_of(Kind kind) {
  std::vector<std::string_view> names = {"file", "layer", "origin", "scale"};
  if (kind == Kind::kDim) names.push_back("name");
  return names;
}

void take_argument(std::string_view name, const Value& value, Kind kind,
                   const CallCode& code, Frame& frame, Query& query) {
  if (name == "file") {
    query.written_file = to_text(value);
    const std::string folder =
        kind == Kind::kDim ? folder_of(frame) : frame.in.design_folder();
    query.path = find_file(query.written_file, folder, code.range, frame.in);
  } else if (name == "layer") {
    query.layer = to_text(value);
  } else if (name == "origin") {
    const std::optional<Vec2> origin = to_vec2(value);
    if (origin) query.origin = *origin;
    if (!origin || !std::isfinite(origin->x) || !std::isfinite(origin->y)) {
      warn(code, frame, "{}(..., origin={}) could not be converted", code.name,
           to_echo(value));
    }
  } else if (name == "scale") {
    if (value.is_number()) query.scale = value.as_number();
  } else {
    query.name = to_text(value);
  }
}

// In 2021.01 all arguments go by name.
Query read_query(Kind kind, const CallCode& code, Frame& frame) {
  const std::vector<std::string_view> names = parameters_of(kind);
  Query query;
  if (!frame.in.is_2021()) {
    const std::vector<Value> values =
        run_named_arguments(names, names.size(), code, frame);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (values[i].is_undef()) continue;
      take_argument(names[i], values[i], kind, code, frame, query);
    }
    return query;
  }
  for (const WrittenArgument& argument : code.arguments) {
    const Value value = run(argument.value, frame);
    if (std::ranges::find(names, argument.name) != names.end()) {
      take_argument(argument.name, value, kind, code, frame, query);
    } else {
      warn(code, frame, "{}(..., {}=...) is not supported", code.name,
           argument.name);
    }
  }
  return query;
}

bool can_open(const Query& query, const CallCode& code, Frame& frame) {
  if (frame.in.file_access().is_there(query.path)) {
    frame.in.add_file(query.path);
    return true;
  }
  warn(code, frame, "Can't open DXF file '{}'!", query.written_file);
  return false;
}

// Reads the drawing; it is empty where the file cannot be read.
DxfDrawing read_drawing(const Query& query, const CallCode& code,
                        Frame& frame) {
  DxfOptions options{query.layer, query.origin, query.scale, {}, query.path};
  // OpenSCAD measures circles of 36 sides.
  options.fragments = [](double) { return 36; };
  DxfDrawing drawing;
  try {
    const auto bytes = frame.in.file_access().read_regular(query.path);
    if (bytes) drawing = parse_dxf(*bytes, options);
  } catch (const FormatError& fault) {
    warn(code, frame, "{} importing file '{}'", fault.what(), query.path);
  }
  for (const std::string& warning : drawing.warnings) {
    frame.in.warn({}, warning);
  }
  for (const std::string& warning : unknown_entity_warnings(
           drawing, query.layer, relative_quoted(query.path, frame))) {
    frame.in.warn({}, warning);
  }
  return drawing;
}

// The measured value; no value for a kind of dimension that measures nothing.
std::optional<double> length_of(const DxfDimension& dimension) {
  const auto& p = dimension.points;
  const auto distance = [](Vec2 d) { return std::sqrt(d.x * d.x + d.y * d.y); };
  switch (dimension.type & 7) {
    case 0: {  // rotated, horizontal or vertical
      const Vec2 d = p[4] - p[3];
      return std::fabs(d.x * cos_deg(dimension.angle_deg) +
                       d.y * sin_deg(dimension.angle_deg));
    }
    case 1:  // aligned
      return distance(p[4] - p[3]);
    case 2: {  // angular
      const Vec2 a = p[0] - p[5];
      const Vec2 b = p[4] - p[3];
      return std::fabs(atan2_deg(a.x, a.y) - atan2_deg(b.x, b.y));
    }
    case 3:  // diameter
    case 4:  // radius
      return distance(p[5] - p[0]);
    case 6:  // ordinate
      return (dimension.type & 64) != 0 ? p[3].x : p[3].y;
    default:
      return std::nullopt;
  }
}

}  // namespace

Value builtin_dxf_dim(const CallCode& code, Frame& frame) {
  const Query query = read_query(Kind::kDim, code, frame);
  if (!can_open(query, code, frame)) return Value();
  const DxfDrawing drawing = read_drawing(query, code, frame);
  for (const DxfDimension& dimension : drawing.dimensions) {
    if (!query.name.empty() && dimension.name != query.name) continue;
    if (const std::optional<double> length = length_of(dimension)) {
      return Value(*length);
    }
    return warn(code, frame,
                "Dimension '{}' in '{}', layer '{}' has unsupported type!",
                query.name, query.written_file, query.layer);
  }
  return warn(code, frame, "Can't find dimension '{}' in '{}', layer '{}'!",
              query.name, query.written_file, query.layer);
}

Value builtin_dxf_cross(const CallCode& code, Frame& frame) {
  const Query query = read_query(Kind::kCross, code, frame);
  if (!can_open(query, code, frame)) return Value();
  // The first two lines that no other line touches.
  std::vector<Vec2> ends;
  for (const DxfPath& path : read_drawing(query, code, frame).paths) {
    if (path.is_closed || path.points.size() != 2) continue;
    ends.insert(ends.end(), path.points.begin(), path.points.end());
  }
  if (ends.size() >= 4) {
    const auto [a, b, c, d] = std::array{ends[0], ends[1], ends[2], ends[3]};
    const double denominator =
        (d.y - c.y) * (b.x - a.x) - (d.x - c.x) * (b.y - a.y);
    if (denominator != 0) {
      const double t =
          ((d.x - c.x) * (a.y - c.y) - (d.y - c.y) * (a.x - c.x)) / denominator;
      const double meeting[] = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      return Value::numbers(meeting);
    }
  }
  return warn(code, frame, "Can't find cross in '{}', layer '{}'!",
              query.written_file, query.layer);
}

}  // namespace lamina::csg
