#pragma once
// What the passes of a compilation share and keep for each other, and what they
// report: what the compilation cost, what it made, and how exact that is.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "base/source.h"
#include "compiler/request.h"
#include "csg/cad/cad_reader.h"
#include "csg/scene.h"
#include "csg/text/typesetter.h"
#include "csg/tree.h"
#include "parser/ast.h"
#include "parser/loader.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/check/thin/thin_features.h"
#include "slicer/contour/deviation.h"
#include "slicer/machine/estimate.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {

// What made a side of a thin feature, or what the layer graph found: the lines
// of the design.
struct FeatureOrigin {
  struct Call {
    std::string module;
    std::string place;
  };
  std::string place;        // "ring.scad:12:3", of the leaf
  std::vector<Call> calls;  // modules around it, innermost first
};

// The leaves of a feature: those of both sides, if they differ; of a finding,
// one; none where it is not known.
using FeatureOrigins = std::vector<FeatureOrigin>;

std::vector<FeatureOrigins> origins_of(
    const csg::Scene& scene, std::span<const slicer::ThinFeature> features);
std::vector<FeatureOrigins> origins_of(
    const csg::Scene& scene, std::span<const slicer::Finding> findings);

// One text for each: "lib.scad:8:5 from ring.scad:40:3, ring.scad:12:3".
std::vector<std::string> origin_texts(std::span<const FeatureOrigins> all);

// What the print is made with, as far as it is known.
struct Machine {
  std::optional<slicer::Printer> printer;
  std::optional<slicer::Material> material;
};

struct Report {
  // Processor seconds of the passes; those of slicing are in `slice`.
  double load_seconds = 0;
  double evaluate_seconds = 0;
  double lower_seconds = 0;
  slicer::SliceReport slice;
  // What made each of slice.features.
  std::vector<FeatureOrigins> origins;
  // What made each of the findings of slice.print.
  std::vector<FeatureOrigins> finding_origins;
  // No value where nothing is promised: the paper's contours.
  std::optional<slicer::Deviation> deviation;
  Machine machine;
  slicer::PrintEstimate estimate;
  std::uint64_t snapped_layers = 0;  // slicer::LayerWriter
  std::uint64_t warnings = 0;
  std::uint64_t output_bytes = 0;
  double wall_seconds = 0;
};

// Called with the number of layers done and of all that there can be: with 0
// before the first layer, after each, and with both equal after the last. By
// one thread at a time.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

// Where the modules of a run are looked for (base/file/module.h).
std::vector<std::string> module_folders_of(const Request& request);

struct Compilation {
  // request   outlives the compilation, as do `files`
  // files     say what may be read and written
  // observer  gets every message as it comes up
  Compilation(const Request& its_request, TemporaryFiles& files,
              Diagnostics::Observer observer = nullptr);
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  const FileAccess& file_access() const {
    return temporary_files.file_access();
  }

  // Whether a warning or an error ends the run without an output.
  bool is_strict() const {
    return request.output.is_strict.value_or(file_access().is_confined());
  }

  // Messages of a severity so far.
  std::size_t count(Severity severity) const;

  const Request& request;
  TemporaryFiles& temporary_files;
  // Stack that evaluation may use below the caller's frame.
  std::size_t evaluation_stack = csg::EvaluateOptions().stack_bytes;
  Progress on_progress;

  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader;
  text::Typesetter typesetter;
  cad::Reader cad_reader;
  // A pass failed and has reported why. The next ones may still run, for what
  // they report; no layers can be made.
  bool has_failed = false;
  Language language = Language::k2021;  // as asked for, or as load() found
  // Products of the first passes; the scene points into the tree.
  ast::Program program;
  csg::Tree tree;
  Report report;
  const std::chrono::steady_clock::time_point begin =
      std::chrono::steady_clock::now();
};

// The files on which the output depends, as far as the passes have come: what
// the design includes, uses, imports, whether it is there or not; fonts,
// parameters, profiles. Some may be there twice.
std::vector<std::string> files_read(const Compilation& compilation);

}  // namespace lamina::compiler
