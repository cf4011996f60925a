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

std::string facets_text(const Facets& facets) {
  return fmt::format("$fn = {:g}, $fa = {:g}, $fs = {:g}", facets.fn, facets.fa,
                     facets.fs);
}

// Makes a leaf that stands for itself in `.csg` with `csg_text`.
template <typename Leaf, typename Params>
void make_leaf(Params params, std::string_view csg_text,
               const ModuleCall& call) {
  params.csg_text = call.in.keep_text(csg_text);
  call.in.make_node(Leaf{call.in.keep(params)}, call.code, call.in.node_mark());
}

// --- text -------------------------------------------------------------------

void text(const BuiltinModuleCode& code, Frame& frame) {
  const ModuleCall call(code, frame);
  const auto keep_text = [&](std::string_view name, std::string_view fallback) {
    return call.in.keep_text(string_or(call[name], fallback));
  };
  TextParams params;
  params.text = keep_text("text", "");
  params.size = number_or(call["size"], 10.0);
  params.spacing = number_or(call["spacing"], 1.0);
  params.font = keep_text("font", "");
  params.script = call.in.keep_text(
      text_script(params.text, string_or(call["script"], "")));
  params.direction =
      text_direction(params.script, string_or(call["direction"], ""));
  params.language = keep_text("language", "en");
  params.halign = keep_text("halign", "left");
  params.valign = keep_text("valign", "baseline");
  params.facets = current_facets(call.in);
  // OpenSCAD quotes these strings without escaping anything.
  std::string csg = fmt::format(
      "text(text = \"{}\", size = {:g}, spacing = {:g}, font = \"{}\", "
      "direction = \"{}\", language = \"{}\", ",
      params.text, params.size, params.spacing, params.font, params.direction,
      params.language);
  if (!params.script.empty()) {
    csg += fmt::format("script = \"{}\", ", params.script);
  }
  csg += fmt::format("halign = \"{}\", valign = \"{}\", {})", params.halign,
                     params.valign, facets_text(params.facets));
  make_leaf<Text>(params, csg, call);
}

// --- surface ----------------------------------------------------------------

void surface(const BuiltinModuleCode& code, Frame& frame) {
  const ModuleCall call(code, frame);
  const Value& file = call["file"];
  const std::string path =
      find_file(file.is_undef() ? "" : to_text(file), call);
  SurfaceParams params;
  params.path = frame.in.keep_text(path);
  params.center = is_set(call["center"]);
  params.invert = is_set(call["invert"]);
  params.convexity = std::max(to_int(call["convexity"]), 1);
  const std::string csg =
      fmt::format("surface(file = {}, center = {}, invert = {}, {})",
                  relative_quoted(path, frame), params.center, params.invert,
                  timestamp_text(path, frame));
  make_leaf<Surface>(params, csg, call);
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
                const ModuleCall& call) {
  constexpr double kDefaultDpi = 72.0;
  const double dpi = number_or(value, kDefaultDpi);
  if (!(dpi < 0.001)) return dpi;
  // The origin and the second file are wrong in OpenSCAD, too.
  const std::string file =
      relative_path(call.code.range.source->path(), call.frame);
  call.in.warn(
      {},
      fmt::format("Invalid dpi value giving, using default of {} dpi. Value "
                  "must be positive and >= 0.001, file {}, import() at line {}",
                  to_echo(origin), file, file));
  return kDefaultDpi;
}

void import(const BuiltinModuleCode& code, Frame& frame) {
  const ModuleCall call(code, frame);
  const Value file =
      renamed(call["file"], call["filename"], "filename", "file", frame);
  const std::string path =
      find_file(file.is_undef() ? "" : to_text(file), call);
  const Value layer =
      renamed(call["layer"], call["layername"], "layername", "layer", frame);
  Interpreter& in = frame.in;
  ImportParams params;
  params.path = in.keep_text(path);
  params.format = import_format(code.name, path);
  params.layer = in.keep_text(layer.is_undef() ? "" : to_text(layer));
  // The name is wrong in OpenSCAD, too.
  params.origin = read_origin(call["origin"], "linear_extrude", call);
  params.center = is_set(call["center"]);
  params.dpi = read_dpi(call["dpi"], call["origin"], call);
  const double scale = call["scale"].number_or_zero();
  params.scale = scale <= 0 ? 1 : scale;
  params.convexity = std::max(to_int(call["convexity"]), 1);
  params.facets = current_facets(in);
  std::string csg = "import(" + drawing_text(params, frame);
  if (params.format == ImportFormat::kSvg) {
    csg += fmt::format("center = {}, dpi = {:g}, ", params.center, params.dpi);
  }
  csg += fmt::format("scale = {:g}, convexity = {}, {}, {})", params.scale,
                     params.convexity, facets_text(params.facets),
                     timestamp_text(path, frame));
  make_leaf<Import>(params, csg, call);
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
