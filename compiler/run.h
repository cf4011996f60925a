#pragma once
// A run over a design, and its passes as far as layers.
//
// Each pass appends to Diagnostics and throws where the run must end.

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/output_file.h"
#include "cli/report/terminal.h"
#include "compiler/design_options.h"
#include "compiler/report.h"
#include "csg/eval/evaluator.h"
#include "csg/lower/lower.h"
#include "csg/text/typesetter.h"
#include "parser/loader.h"
#include "slicer/contour/layer.h"
#include "slicer/slice/settings.h"

namespace lamina::cli {

// What the passes of a run share.
struct Run {
  // stack  bytes of the thread that runs it
  // inbox  as of Terminal
  Run(const DesignOptions& run_options, TemporaryFiles& files,
      std::size_t stack, Inbox* inbox = nullptr);

  // What may be read and written.
  const FileAccess& file_access() const {
    return temporary_files.file_access();
  }

  const DesignOptions& options;
  TemporaryFiles& temporary_files;
  std::size_t evaluation_stack;
  Terminal terminal;
  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader;
  text::Typesetter typesetter{text::module_folders(), diagnostics,
                              file_access()};
  RunReport report;
  // Files that modules of the design name: drawings, meshes, images. Known
  // when the design has been evaluated.
  std::vector<std::string> named_files;
  const std::chrono::steady_clock::time_point begin =
      std::chrono::steady_clock::now();
};

void write_text(Run& run, const std::string& path, std::string_view text);

std::size_t count(const Diagnostics& diagnostics, Severity severity);

// All messages so far, as openscad's `.echo` holds them.
std::string echo_text(const Run& run);

[[noreturn]] void refuse_geometry(const std::string& words);

// The design with the values of its parameter set.
struct Loaded {
  ast::Program program;
  bool has_failed = false;  // the set could not be used
};

Loaded load(Run& run);

// The tree of the design; has_failed tells a failed assertion, endless
// recursion or, under hard warnings, a warning. The tree is empty then.
struct Evaluated {
  csg::Tree tree;
  bool has_failed = false;
};

Evaluated evaluate(Run& run, const ast::Program& program);

// Both of these; no value where either failed.
std::optional<csg::Tree> load_tree(Run& run);

// The solid or the outline that the tree stands for; throws where it is empty.
// Drops the tree's nodes; the solid needs what is left of it.
csg::Lowered lower(Run& run, csg::Tree& tree);

// Sections of what was lowered; may be called again, with other settings.
void slice(Run& run, const csg::Lowered& lowered,
           const slicer::Settings& settings, slicer::LayerSink& sink);

// From the CSG tree to layers in `sink`: both of these. Throws where the
// format of the output holds no outline and the design is one.
void make_layers(Run& run, csg::Tree tree, slicer::LayerSink& sink);

// Keeps all layers.
struct LayerList : slicer::LayerSink {
  void take(const slicer::Layer& layer) override { layers.push_back(layer); }
  std::vector<slicer::Layer> layers;
};

// Returns what `work` returns; where it throws, shows the message, unless it
// is among `diagnostics` and so has been shown, and returns kFault.
int run_caught(Terminal& terminal, const Diagnostics& diagnostics,
               const std::function<int()>& work);

}  // namespace lamina::cli
