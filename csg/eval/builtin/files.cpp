// text, import, surface: modules whose shape comes from fonts and files.

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>

#include <fmt/format.h>

#include "base/letter_case.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/builtin/script.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

void append_facets(const Facets& facets, std::string& text) {
  text += "$fn = ";
  append_stream_number(facets.fn, text);
  text += ", $fa = ";
  append_stream_number(facets.fa, text);
  text += ", $fs = ";
  append_stream_number(facets.fs, text);
}

void append_number_field(std::string_view name, double number,
                         std::string& text) {
  text += name;
  text += " = ";
  append_stream_number(number, text);
  text += ", ";
}

// Makes a leaf that stands for itself in `.csg` with `csg_text`.
template <typename Leaf, typename Params>
void make_leaf(Params params, const std::string& csg_text,
               const BuiltinModuleCode& code, Frame& frame) {
  Interpreter& in = frame.in;
  params.csg_text = in.keep_text(csg_text);
  in.make_node(Leaf{in.keep(params)}, code, in.node_mark());
}

// --- text -------------------------------------------------------------------

void text(const BuiltinModuleCode& code, Frame& frame) {
  enum {
    kText,
    kSize,
    kFont,
    kDirection,
    kLanguage,
    kScript,
    kHalign,
    kValign,
    kSpacing
  };
  const ModuleArguments arguments(code, frame);
  Interpreter& in = frame.in;
  const std::string_view content = string_or(arguments[kText], "");
  const std::string script =
      text_script(content, string_or(arguments[kScript], ""));
  TextParams params;
  params.text = in.keep_text(content);
  params.size = number_or(arguments[kSize], 10.0);
  params.spacing = number_or(arguments[kSpacing], 1.0);
  params.font = in.keep_text(string_or(arguments[kFont], ""));
  params.direction = in.keep_text(
      text_direction(script, string_or(arguments[kDirection], "")));
  params.language = in.keep_text(string_or(arguments[kLanguage], "en"));
  params.script = in.keep_text(script);
  params.halign = in.keep_text(string_or(arguments[kHalign], "left"));
  params.valign = in.keep_text(string_or(arguments[kValign], "baseline"));
  params.facets = current_facets(in);
  std::string csg = "text(";
  // OpenSCAD quotes these strings without escaping anything.
  const auto append_string = [&csg](std::string_view name,
                                    std::string_view value) {
    csg += name;
    csg += " = \"";
    csg += value;
    csg += "\", ";
  };
  append_string("text", params.text);
  append_number_field("size", params.size, csg);
  append_number_field("spacing", params.spacing, csg);
  append_string("font", params.font);
  append_string("direction", params.direction);
  append_string("language", params.language);
  if (!script.empty()) append_string("script", script);
  append_string("halign", params.halign);
  append_string("valign", params.valign);
  append_facets(params.facets, csg);
  make_leaf<Text>(params, csg + ")", code, frame);
}

// --- surface ----------------------------------------------------------------

void surface(const BuiltinModuleCode& code, Frame& frame) {
  enum { kFile, kCenter, kConvexity, kInvert };
  const ModuleArguments arguments(code, frame);
  const Value& file = arguments[kFile];
  const std::string path =
      find_file(file.is_undef() ? "" : to_text(file), code, frame);
  SurfaceParams params;
  params.path = frame.in.keep_text(path);
  params.center = is_set(arguments[kCenter]);
  params.invert = is_set(arguments[kInvert]);
  params.convexity = std::max(to_int(arguments[kConvexity]), 1);
  const std::string csg =
      fmt::format("surface(file = {}, center = {}, invert = {}, {})",
                  relative_quoted(path, frame), params.center, params.invert,
                  timestamp_text(path, frame));
  make_leaf<Surface>(params, csg, code, frame);
}

// --- import -----------------------------------------------------------------

// The format by the file's extension, in any letter case. import_stl() and its
// like name the format themselves.
ImportFormat import_format(std::string_view module, const std::string& path) {
  constexpr std::string_view kPrefix = "import_";
  std::string extension =
      module.starts_with(kPrefix)
          ? std::string(module.substr(kPrefix.size()))
          : std::filesystem::path(path).extension().string();
  if (extension.starts_with('.')) extension.erase(0, 1);
  extension = lower_case(extension);
  static const std::map<std::string_view, ImportFormat> kFormats = {
      {"stl", ImportFormat::kStl}, {"off", ImportFormat::kOff},
      {"obj", ImportFormat::kObj}, {"amf", ImportFormat::kAmf},
      {"3mf", ImportFormat::k3mf}, {"dxf", ImportFormat::kDxf},
      {"svg", ImportFormat::kSvg}};
  const auto found = kFormats.find(extension);
  return found == kFormats.end() ? ImportFormat::kUnknown : found->second;
}

// A parameter, or its deprecated name.
Value renamed(const Value& value, const Value& old, std::string_view old_name,
              std::string_view name, Frame& frame) {
  if (!value.is_undef() || old.is_undef()) return value;
  frame.in.deprecate(
      {}, fmt::format("{}= is deprecated. Please use {}=", old_name, name));
  return old;
}

double read_dpi(const Value& value, const Value& origin,
                const BuiltinModuleCode& code, Frame& frame) {
  constexpr double kDefaultDpi = 72.0;
  const double dpi = number_or(value, kDefaultDpi);
  if (!(dpi < 0.001)) return dpi;
  // The origin and the second file are wrong in OpenSCAD, too.
  const std::string file = relative_path(code.range.source->path(), frame);
  frame.in.warn({}, fmt::format("Invalid dpi value giving, using default of {} "
                                "dpi. Value must be positive and >= 0.001, "
                                "file {}, import() at line {}",
                                to_echo(origin), file, file));
  return kDefaultDpi;
}

void import(const BuiltinModuleCode& code, Frame& frame) {
  enum {
    kFile,
    kLayer,
    kConvexity,
    kOrigin,
    kScale,
    kWidth,
    kHeight,
    kFilename,
    kLayername,
    kCenter,
    kDpi
  };
  const ModuleArguments arguments(code, frame);
  const Value file = renamed(arguments[kFile], arguments[kFilename], "filename",
                             "file", frame);
  const std::string path =
      find_file(file.is_undef() ? "" : to_text(file), code, frame);
  const Value layer = renamed(arguments[kLayer], arguments[kLayername],
                              "layername", "layer", frame);
  Interpreter& in = frame.in;
  ImportParams params;
  params.path = in.keep_text(path);
  params.format = import_format(code.name, path);
  params.layer = in.keep_text(layer.is_undef() ? "" : to_text(layer));
  // The name is wrong in OpenSCAD, too.
  params.origin =
      read_origin(arguments[kOrigin], "linear_extrude", code, frame);
  params.center = is_set(arguments[kCenter]);
  params.dpi = read_dpi(arguments[kDpi], arguments[kOrigin], code, frame);
  const double scale = arguments[kScale].number_or_zero();
  params.scale = scale <= 0 ? 1 : scale;
  params.convexity = std::max(to_int(arguments[kConvexity]), 1);
  params.facets = current_facets(in);
  std::string csg = "import(" + drawing_text(params, frame);
  if (params.format == ImportFormat::kSvg) {
    csg += fmt::format("center = {}, ", params.center);
    append_number_field("dpi", params.dpi, csg);
  }
  append_number_field("scale", params.scale, csg);
  csg += fmt::format("convexity = {}, ", params.convexity);
  append_facets(params.facets, csg);
  make_leaf<Import>(params, csg + ", " + timestamp_text(path, frame) + ")",
                    code, frame);
}

}  // namespace

std::vector<BuiltinModuleRow> file_rows() {
  const std::vector<std::string_view> positional = {
      "file", "layer", "convexity", "origin", "scale"};
  const std::vector<std::string_view> optional = {
      "width", "height", "filename", "layername", "center", "dpi"};
  return {
      {"text",
       text,
       {"text", "size", "font"},
       {"direction", "language", "script", "halign", "valign", "spacing"}},
      {"surface", surface, {"file", "center", "convexity"}, {"invert"}},
      {"import", import, positional, optional},
      {"import_stl", import, positional, optional, "import()"},
      {"import_off", import, positional, optional, "import()"},
      {"import_dxf", import, positional, optional, "import()"},
  };
}

}  // namespace lamina::csg
