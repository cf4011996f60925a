#pragma once
// A design's way to its output: layers, or the text of a stage before.
//
//   load, parse ─▶ evaluate ─▶ lower ─▶ plan ─▶ slice ─▶ write
//
// Each pass appends to Diagnostics and throws where the compilation must end.
// The program, the library, tests and benchmarks call the same passes.

#include <memory>
#include <optional>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "compiler/compilation.h"
#include "csg/lower/lower.h"
#include "slicer/contour/layer.h"
#include "slicer/formats/layer_writer.h"
#include "slicer/machine/build_volume.h"

namespace lamina::compiler {

// All passes that the format of the output asks for, and the report. Returns
// false where a pass failed.
bool compile(Compilation& compilation);

// The passes from the text to the tree. Returns false where one failed.
bool make_tree(Compilation& compilation);

// The pass from the tree to what can be sliced; drops the tree's nodes. Throws
// GeometryError where that is nothing, or an outline that the format of the
// output cannot hold.
csg::Lowered lower_tree(Compilation& compilation);

// Both of these. No value where the tree could not be made.
std::optional<csg::Lowered> make_geometry(Compilation& compilation);

// The passes from there to layers in `sink`; completes the report's `slice` and
// `origins`. May be called again, with other settings.
void make_layers(Compilation& compilation, const csg::Lowered& lowered,
                 const slicer::Settings& settings, slicer::LayerSink& sink);

// Keeps all layers.
struct LayerList : slicer::LayerSink {
  void take(const slicer::Layer& layer) override { layers.push_back(layer); }
  std::vector<slicer::Layer> layers;
};

// What a request says of the print: the profiles that it names, and of images
// the format's usual printer. Throws FileError where a profile cannot be
// opened.
Machine choose_machine(const Request& request, const FileAccess& access);

// The output of layers that a request asks for.
class LayerOutput {
 public:
  // Opens the output. Throws FileError where it or a profile of the printer or
  // the material cannot be opened. Warns of exposures that are not for them.
  static LayerOutput open(const Request& request,
                          TemporaryFiles& temporary_files,
                          Diagnostics& diagnostics);

  // Takes the layers. Throws GeometryError where the printer cannot build them.
  slicer::LayerSink& sink() {
    if (build_volume_) return *build_volume_;
    return *writer_;
  }

  // Ends the file, gives it its name, and completes the report.
  void finish(Diagnostics& diagnostics, Report& report);

 private:
  LayerOutput(Machine machine, std::optional<slicer::Deviation> deviation,
              std::unique_ptr<slicer::LayerWriter> writer);

  std::unique_ptr<const Machine> machine_;
  std::optional<slicer::Deviation> deviation_;
  std::unique_ptr<slicer::LayerWriter> writer_;
  std::unique_ptr<slicer::BuildVolumeSink> build_volume_;  // of a printer
};

}  // namespace lamina::compiler
