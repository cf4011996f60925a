// Parameter sets.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/ast_printer.h"
#include "parser/loader.h"
#include "parser/parameter_set.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

// A parameter of each type.
constexpr const char* kDesign =
    "text = \"a\";\ntruth = true;\nnumber = 1;\nvector = [1, 2];\n"
    "range = [0 : 1 : 2];\n";

void set_parameters(const std::string& path, const std::string& set) {
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  ast::Program program = loader.load_text("x.scad", kDesign);
  for (const Language language : {Language::k2021, Language::k2026}) {
    apply_parameter_set(path, set, program, language, diagnostics);
  }
  ast::print(program);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string path =
      fuzz::write_input("input.json", fuzz::as_text(data, size));
  set_parameters(path, "");
  try {
    for (const std::string& set : parameter_set_names(path))
      set_parameters(path, set);
  } catch (const FileError&) {
  }
  return 0;
}
