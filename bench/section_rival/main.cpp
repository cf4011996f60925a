// The rival of bench/rivals: cuts every leaf's mesh by each layer and evaluates
// the Boolean program on the polygons with Clipper (libpolyclipping).
//
//   build/release/bench/section_rival design.scad -o out.slc [--layer 0.05]
//       [-D name=value]…
//
// This is how hob3l works, and PrusaSlicer inside. The design is read and
// lowered by lamina's own front end, so that both have the same leaves, layers
// and Boolean program; each leaf then becomes triangles, and what follows is
// the rival's own. Prints the peak of its memory.

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/file/output_file.h"
#include "bench/section_rival/scene_sweep.h"
#include "compiler/compile.h"

namespace lamina::rival {
namespace {

struct Options {
  std::string design;
  std::string output;
  std::string definitions;
  double thickness = 0.05;  // [mm]
};

Options parse_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    if (name.front() != '-') {
      options.design = name;
    } else if (i + 1 < argc) {
      const std::string value = argv[++i];
      if (name == "-o") options.output = value;
      if (name == "-D") options.definitions += value + ";\n";
      if (name == "--layer") options.thickness = std::stod(value);
    }
  }
  return options;
}

// The most memory that the process held, as the system words it.
std::string peak_memory() {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line) && !line.starts_with("VmHWM:")) {
  }
  return line;
}

void run(const Options& options) {
  compiler::Request request;
  request.design.path = options.design;
  request.design.definitions = options.definitions;
  TemporaryFiles files;
  compiler::Compilation compilation(request, files);
  const auto lowered = compiler::make_geometry(compilation);
  if (!lowered) throw std::runtime_error("the design has errors");
  OutputFile output = OutputFile::open(options.output, files);
  slice_by_sections(*lowered->scene(), options.thickness, output);
  output.commit();
}

}  // namespace
}  // namespace lamina::rival

int main(int argc, char** argv) {
  using namespace lamina::rival;
  const Options options = parse_options(argc, argv);
  if (options.design.empty() || options.output.empty()) {
    std::fputs(
        "usage: section_rival design.scad -o out.slc [--layer 0.05] "
        "[-D name=value]...\n",
        stderr);
    return 2;
  }
  try {
    run(options);
    std::puts(peak_memory().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "section_rival: %s\n", error.what());
    return 1;
  }
}
