// text, import, surface: modules whose shape comes from fonts and files.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/text.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/builtin/text_arguments.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/text.h"
#include "csg/import/freecad/freecad_file.h"
#include "csg/import/mesh_file.h"
#include "csg/limits.h"

namespace lamina::csg {

namespace {

std::string facets_text(const Facets& facets) {
  const std::string fe =
      facets.fe > 0 ? fmt::format("$fe = {:g}, ", facets.fe) : "";
  return fmt::format("$fn = {:g}, {}$fa = {:g}, $fs = {:g}", facets.fn, fe,
                     facets.fa, facets.fs);
}

// Makes a leaf that stands for itself in `.csg` with `csg_text`.
template <typename Leaf, typename Params>
void make_leaf(Params params, std::string_view csg_text,
               const ModuleCall& call) {
  params.csg_text = call.in.keep_text(csg_text);
  call.in.make_node(Leaf{call.in.keep(params)}, call.code, call.in.node_mark());
}

// --- text -------------------------------------------------------------------

TextParams read_text(const ModuleCall& call) {
  TextArguments arguments;
  arguments.find = [&](std::string_view name) -> const Value& {
    return call[name];
  };
  arguments.warn = [&](const std::string& words) { call.warn("{}", words); };
  arguments.caller = "text";
  arguments.language = call.in.language();
  // 2021.01 takes what has another type for nothing, without a word.
  if (arguments.language != Language::k2021) check_types(arguments);
  std::string script;
  TextParams params = read_text(arguments, script);
  for (std::string_view* const view :
       {&params.text, &params.font, &params.script, &params.direction,
        &params.language, &params.halign, &params.valign}) {
    *view = call.in.keep_text(*view);
  }
  params.facets = facets_of(call);
  return params;
}

void text(const BuiltinModuleCode& code, Frame& frame) {
  if (!frame.in.is_2021()) warn_of_children(code, frame);
  const ModuleCall call(code, frame);
  const TextParams params = read_text(call);
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
  if (!frame.in.is_2021()) warn_of_children(code, frame);
  const ModuleCall call(code, frame);
  const Value& file = call["file"];
  const std::string path =
      find_file(file.is_undef() ? "" : to_text(file), call);
  SurfaceParams params;
  params.path = frame.in.keep_text(path);
  params.rules = frame.in.language();
  params.center = is_set(call["center"]);
  params.invert = is_set(call["invert"]);
  params.convexity = std::max(to_int(call["convexity"]), 1);
  const std::string csg =
      fmt::format("surface(file = {}, center = {}, invert = {}, {})",
                  relative_quoted(path, frame), params.center, params.invert,
                  timestamp_text(path, frame));
  make_leaf<Surface>(params, csg, call);
}

// --- FreeCAD files -----------------------------------------------------------

// Reads the file; a fault of it ends the evaluation.
FreecadModel read_file(std::string_view bytes, const FreecadOptions& options,
                       const ModuleCall& call) {
  const std::string file =
      relative_quoted(std::string(options.path), call.frame);
  std::string fault;
  try {
    return read_freecad(bytes, options, call.in.node_arena());
  } catch (const FormatError& error) {
    fault = error.what();
  } catch (const plane::LimitExceeded& error) {
    fault = error.diagnostic().message;
  }
  call.in.fail(call.code.range,
               fmt::format("{}, importing file {}", on_one_line(fault), file),
               nullptr);
}

// The path of the file that the one at `from` links to, under the rules of all
// files that a design names.
//
// first  the path of the file that import() names
std::string_view find_linked(std::string_view from, std::string_view linked,
                             const std::string& first, const ModuleCall& call) {
  Interpreter& in = call.in;
  const FileAccess& access = in.file_access();
  const std::string found =
      find_file(linked, std::filesystem::path(from).parent_path().string(),
                call.code.range, in);
  in.add_file(found);
  const std::string path = access.weakly_canonical(found);
  return in.keep_text(path == access.canonical(first) ? first : path);
}

// Adds a group of what the file shows, or of the object of that name or label.
// Warns of what is left out, and fails where the file is broken or lacks it.
void import_freecad(const std::string& path,
                    const std::optional<std::string>& part,
                    const ModuleCall& call) {
  Interpreter& in = call.in;
  const std::size_t mark = in.node_mark();
  const SourceRange range = call.code.range;
  const std::string file = relative_quoted(path, call.frame);
  const auto bytes = in.file_access().read_regular(path);
  if (!bytes) {
    in.fail(range, fmt::format("Can't open import file {}", file), nullptr);
  }
  FreecadOptions options;
  options.path = in.keep_text(path);
  options.part = part;
  options.chordal_error = in.options().chordal_error;
  options.most_leaves = in.leaves_left();
  options.range = range;
  options.caller = in.current_call;
  options.boundary_text = [&](std::string_view of, std::string_view name) {
    return fmt::format("import(file = {}, part = {}, {})",
                       relative_quoted(std::string(of), call.frame),
                       in_quotes(name),
                       timestamp_text(std::string(of), call.frame));
  };
  options.find_linked = [&](std::string_view from, std::string_view linked) {
    return find_linked(from, linked, path, call);
  };
  options.read_linked = [&](std::string_view linked) {
    return in.file_access().read_regular(std::string(linked));
  };
  const FreecadModel model = read_file(*bytes, options, call);
  // Whatever names objects, types and entries have.
  for (const std::string& note : model.notes) in.note(on_one_line(note));
  for (const std::string& warning : model.warnings) {
    call.warn("{}{}", on_one_line(warning), at_import(range));
  }
  if (model.nodes.empty()) call.warn("File {} shows nothing to import", file);
  in.add_nodes(model.nodes, model.leaves, range);
  in.make_node(Group{}, call.code, mark);
}

// --- import -----------------------------------------------------------------

// The format by the file's extension. import_stl() and its like name the format
// themselves.
ImportFormat import_format(std::string_view module, const std::string& path) {
  constexpr std::string_view kPrefix = "import_";
  return module.starts_with(kPrefix)
             ? import_format_of(module.substr(kPrefix.size()))
             : import_format_of_file(path);
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

// How far decimation may move a mesh; no value where that is not said.
std::optional<double> read_decimate(const ModuleCall& call) {
  const Value& value = call["decimate"];
  if (value.is_undef()) return std::nullopt;
  const double length = number_or(value, -1);
  // The least is that of --chordal-error.
  constexpr double kLeast = 1e-6;
  const bool is_length = std::isfinite(length) && length >= kLeast;
  if (is_length || length == 0) return length;
  call.warn(
      "import() ignores decimate = {}: expected a distance of at least "
      "0.000001, or 0 for none",
      to_echo(value));
  return std::nullopt;
}

// What 2021.01 accepts of such files, and passes over, is passed over where its
// rules count. What it does not know at all always counts.
bool is_center_ignored(const ImportParams& params) {
  if (params.rules != Language::k2021) return false;
  switch (params.format) {
    case ImportFormat::kStl:
    case ImportFormat::kOff:
    case ImportFormat::kAmf:
    case ImportFormat::k3mf:
    case ImportFormat::kDxf:
      return true;
    default:
      return false;
  }
}
bool is_layer_ignored(const ImportParams& params) {
  return params.rules == Language::k2021 && params.format == ImportFormat::kSvg;
}

void warn_of_ignored(std::string_view argument, const ModuleCall& call) {
  call.warn(
      "import() ignores {}, as OpenSCAD 2021.01 does of such files; with "
      "--language 2026 it counts",
      argument);
}

// What 2021.01 does not know stands in its text only where it was given.
std::string import_text(const ImportParams& params, Frame& frame) {
  const std::string file = relative_quoted(std::string(params.path), frame);
  const std::string origin =
      fmt::format("origin = [{:g}, {:g}], ", params.origin.x, params.origin.y);
  const char* const id_name = has_parts(params.format) ? "part" : "id";
  const std::string id =
      params.id ? fmt::format("{} = {}, ", id_name, in_quotes(*params.id)) : "";
  const std::string dpi = params.format == ImportFormat::kSvg
                              ? fmt::format("dpi = {:g}, ", params.dpi)
                              : "";
  const std::string center = fmt::format("center = {}, ", params.center);
  const std::string decimate =
      params.decimate ? fmt::format("decimate = {:g}, ", *params.decimate) : "";
  const std::string end =
      fmt::format("{}convexity = {}, {}, {})", decimate, params.convexity,
                  facets_text(params.facets),
                  timestamp_text(std::string(params.path), frame));
  if (params.rules == Language::k2021) {
    const bool has_center =
        params.center || params.format == ImportFormat::kSvg;
    return fmt::format("import(file = {}, layer = {}, {}{}{}{}scale = {:g}, {}",
                       file, in_quotes(params.layer.value_or("")), id, origin,
                       has_center ? center : "", dpi, params.scale, end);
  }
  const std::string layer =
      params.layer ? fmt::format("layer = {}, ", in_quotes(*params.layer)) : "";
  return fmt::format("import(file = {}, {}{}{}{}scale = {:g}, {}{}", file, id,
                     layer, origin, dpi, params.scale, center, end);
}

void import(const BuiltinModuleCode& code, Frame& frame) {
  if (!frame.in.is_2021()) warn_of_children(code, frame);
  const ModuleCall call(code, frame);
  const Value file =
      renamed(call["file"], call["filename"], "filename", "file", frame);
  const std::string path =
      find_file(file.is_undef() ? "" : to_text(file), call);
  const Value layer =
      renamed(call["layer"], call["layername"], "layername", "layer", frame);
  Interpreter& in = frame.in;
  const Value& id = call["id"];
  const Value& part = call["part"];
  ImportParams params;
  params.path = in.keep_text(path);
  params.format = import_format(code.name, path);
  if (params.format == ImportFormat::kFcstd) {
    for (const char* name : {"center", "scale", "decimate", "origin", "dpi"}) {
      if (!call[name].is_undef()) {
        call.warn("{}= has no say in FreeCAD files", name);
      }
    }
    return import_freecad(
        path, part.is_undef() ? std::nullopt : std::optional(to_text(part)),
        call);
  }
  const bool is_of_parts = has_parts(params.format);
  if (!part.is_undef() && !is_of_parts) {
    call.warn("part= names objects of CAD and 3MF files only");
  }
  params.rules = in.language();
  params.is_design = in.options().is_file;
  if (const Value& named = is_of_parts ? part : id; !named.is_undef()) {
    params.id = in.keep_text(to_text(named));
  }
  if (!layer.is_undef()) params.layer = in.keep_text(to_text(layer));
  // The name is wrong in 2021.01, too.
  params.origin = read_origin(call["origin"], "linear_extrude", call);
  params.center = is_set(call["center"]);
  if (params.center && is_center_ignored(params)) {
    warn_of_ignored("center = true", call);
    params.center = false;
  }
  params.dpi = read_dpi(call["dpi"], call["origin"], call);
  const double scale = call["scale"].number_or_zero();
  params.scale = scale <= 0 ? 1 : scale;
  params.decimate = read_decimate(call);
  params.convexity = std::max(to_int(call["convexity"]), 1);
  params.facets = facets_of(call);
  const std::string csg_text = import_text(params, frame);
  if (params.layer && is_layer_ignored(params)) {
    // Dumps of 2021.01 have an empty one for each import().
    if (!params.layer->empty()) {
      warn_of_ignored("layer = " + in_quotes(*params.layer), call);
    }
    params.layer.reset();
  }
  make_leaf<Import>(params, csg_text, call);
}

}  // namespace

std::vector<BuiltinModuleRow> file_rows() {
  const std::vector<std::string_view> positional = {
      "file", "layer", "convexity", "origin", "scale"};
  const std::vector<std::string_view> optional = {
      "width", "height", "filename", "layername", "center",
      "dpi",   "id",     "part",     "decimate"};
  return {
      {"text",
       text,
       {"text", "size", "font"},
       {"direction", "language", "script", "halign", "valign", "spacing",
        "em"}},
      {"surface", surface, {"file", "center", "convexity"}, {"invert"}},
      {"import", import, positional, optional},
      {"import_stl", import, positional, optional, "import()"},
      {"import_off", import, positional, optional, "import()"},
      {"import_dxf", import, positional, optional, "import()"},
  };
}

}  // namespace lamina::csg
