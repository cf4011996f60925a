#pragma once
// What the passes of a compilation share and keep for each other, and what they
// report: what the compilation cost, what it made, and how exact that is.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "base/source.h"
#include "compiler/machine.h"
#include "compiler/passes.h"
#include "compiler/request.h"
#include "compiler/source_lines.h"
#include "slicer/contour/deviation.h"
#include "slicer/machine/estimate.h"

namespace lamina::compiler {

// The direction of building that a search found.
struct FoundDirection {
  Vec3 up;                 // as GeometryRequest::up
  std::size_t judged = 0;  // among so many
};

struct Report {
  // Processor seconds of the passes; those of slicing are in `slice`.
  double load_seconds = 0;
  double evaluate_seconds = 0;
  double lower_seconds = 0;
  double plan_seconds = 0;
  slicer::SliceReport slice;
  FoundLines lines;  // of what the slicer found
  // No value where nothing is promised: the paper's contours.
  std::optional<slicer::Deviation> deviation;
  Machine machine;
  std::optional<FoundDirection> direction;  // if one was searched for
  // The sprues that were added, if any were asked for.
  std::optional<slicer::SpruePlan> sprues;
  // The supports that were added, if any were asked for.
  std::optional<slicer::SupportPlan> supports;
  std::optional<slicer::HollowReport> hollow;  // if it was asked for
  std::optional<slicer::BleedReport> bleed;    // likewise
  slicer::Compensation compensation;           // that was applied
  slicer::PrintEstimate estimate;
  std::uint64_t snapped_layers = 0;  // slicer::LayerWriter
  std::uint64_t warnings = 0;
  std::uint64_t output_bytes = 0;
  double wall_seconds = 0;
};

struct Compilation {
  // files     say what may be read and written; they outlive the compilation
  // observer  gets every message as it comes up
  Compilation(Request its_request, TemporaryFiles& files,
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

  // Whether read_design() has been called.
  bool is_read() const { return design.program.source != nullptr; }

  // The number of messages of a severity so far.
  std::size_t count(Severity severity) const;

  // As it was asked for; a direction to be found becomes the one that is found.
  Request request;
  TemporaryFiles& temporary_files;
  // Stack that evaluation may use below the caller's frame.
  std::size_t evaluation_stack = csg::EvaluateOptions().stack_bytes;
  Progress on_progress;
  // Called as a pass before the layers begins, "evaluating", and with nothing
  // before a text is written.
  std::function<void(std::string_view)> on_pass = [](std::string_view) {};

  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader;
  Readers readers;
  // A pass failed and has reported why. The next ones may still run, for what
  // they report; no layers can be made.
  bool has_failed = false;
  // Products of the first passes; the scene points into the tree.
  LoadedDesign design;
  csg::Tree tree;
  std::vector<Note> emptiness;  // why the design is nothing, if it is
  Report report;
  const std::chrono::steady_clock::time_point begin =
      std::chrono::steady_clock::now();
};

// Whether a message is one of those that were reported: some passes report what
// they throw.
bool is_among(const Diagnostics& diagnostics, const Diagnostic& message);

// The files on which the output depends, as far as the passes have come: what
// the design includes, uses, imports, whether it is there or not; fonts,
// parameters, profiles. Some may be there twice.
std::vector<std::string> files_read(const Compilation& compilation);

}  // namespace lamina::compiler
