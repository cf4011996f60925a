// Programs, to the CSG tree and its text.
//
// A program may legally run for ever, so its steps are counted. What grows
// without steps (a list of two copies of the last one, again and again) may
// still take minutes or gigabytes: scripts/fuzz takes neither for a finding.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/diagnostic.h"
#include "base/source.h"
#include "csg/csg_printer.h"
#include "csg/eval/evaluator.h"
#include "parser/loader.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

csg::EvaluateOptions few_steps() {
  csg::EvaluateOptions options;
  options.max_steps = 10000;
  options.stack_bytes = std::size_t{1} << 20;
  options.check_ranges = true;
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  try {
    const ast::Program program =
        loader.load_text("x.scad", std::string(fuzz::as_text(data, size)));
    const csg::Tree tree =
        csg::evaluate(program, loader, few_steps(), diagnostics);
    csg::print_csg(tree, *csg::select_root(tree, diagnostics));
  } catch (const SyntaxError&) {
  }
  openscad_text(diagnostics.all(), "");
  return 0;
}
