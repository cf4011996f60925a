// Parameter sets.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/customizer/parameter_set.h"
#include "parser/customizer/program_printer.h"
#include "parser/loader.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

// A parameter of each type.
constexpr const char* kDesign =
    "text = \"a\";\ntruth = true;\nnumber = 1;\nvector = [1, 2];\n"
    "range = [0 : 1 : 2];\n";

void set_parameters(const ParameterSet& set) {
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader(sources, diagnostics, {});
  ast::Program program = loader.load_text("x.scad", kDesign);
  for (const Language language : {Language::k2021, Language::k2026}) {
    apply_parameter_set(set, program, language, diagnostics);
  }
  ast::print(program);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string path =
      fuzz::write_input("input.json", fuzz::as_text(data, size));
  try {
    const ParameterSets sets = ParameterSets::read(path);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      try {
        set_parameters(sets.values_of(i));
      } catch (const FileError&) {  // it is no set
      }
    }
  } catch (const FileError&) {
  }
  return 0;
}
