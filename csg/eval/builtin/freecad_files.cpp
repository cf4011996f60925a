#include "csg/eval/builtin/freecad_files.h"

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/text.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/import/freecad/freecad_file.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

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

}  // namespace

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
  options.boundary_text = [&](std::string_view name) {
    return fmt::format("import(file = {}, part = {}, {})", file,
                       in_quotes(name), timestamp_text(path, call.frame));
  };
  const FreecadModel model = read_file(*bytes, options, call);
  // Whatever names objects, types and entries have.
  for (const std::string& note : model.notes) in.note(on_one_line(note));
  for (const std::string& warning : model.warnings) {
    call.warn("{}, import() at line {}", on_one_line(warning),
              range.openscad_line());
  }
  if (model.nodes.empty()) call.warn("File {} shows nothing to import", file);
  in.add_nodes(model.nodes, model.leaves, range);
  in.make_node(Group{}, call.code, mark);
}

}  // namespace lamina::csg
