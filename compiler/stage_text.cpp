#include "compiler/stage_text.h"

#include <filesystem>

#include <fmt/format.h>

#include "csg/csg_printer.h"
#include "csg/eval/evaluator.h"
#include "parser/customizer/customizer.h"
#include "parser/customizer/program_printer.h"

namespace lamina::compiler {
namespace {

std::string echo_text(Compilation& c) {
  // For what the selection warns of.
  if (c.tree.root != nullptr) csg::select_root(c.tree, c.diagnostics);
  const std::string& design = c.request.design.path;
  const std::size_t slash = design.rfind('/');
  return openscad_text(c.diagnostics.all(), slash == std::string::npos
                                                ? "."
                                                : design.substr(0, slash));
}

std::string csg_text(Compilation& c) {
  if (c.tree.root == nullptr) return "\n";
  return csg::print_csg(c.tree, *csg::select_root(c.tree, c.diagnostics));
}

}  // namespace

std::string stage_text(Compilation& c) {
  using enum slicer::OutputFormat;
  const ast::Program& program = c.design.program;
  switch (c.request.output.format) {
    case kAst:
      return ast::print(program);
    case kParam:
      return parameters_json(
          program,
          std::filesystem::path(c.request.design.path).stem().string());
    case kEcho:
      return echo_text(c);
    default:
      return csg_text(c);
  }
}

std::string text_of_syntax_error(Compilation& c) {
  return echo_text(c) +
         fmt::format("Can't parse file '{}'!\n\n", c.request.design.path);
}

void write_file(const std::string& path, std::string_view text,
                TemporaryFiles& temporary_files) {
  OutputFile output = OutputFile::open(path, temporary_files);
  output.write(text);
  output.commit();
}

}  // namespace lamina::compiler
