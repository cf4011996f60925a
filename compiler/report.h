#pragma once
// What a run cost: the closing line on the terminal and `--report`.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/feature_report.h"
#include "slicer/contour/deviation.h"
#include "slicer/slice/slice.h"

namespace lamina::cli {

// Processor seconds of all threads since the program began.
double process_seconds();

// Greatest memory that this program held so far.
std::uint64_t peak_memory_bytes();

// Processor seconds by pass, what came of it, and how good it is.
struct RunReport {
  double load_seconds = 0;
  double evaluate_seconds = 0;
  double lower_seconds = 0;
  slicer::SliceReport slice;
  // What made each of slice.features.
  std::vector<std::vector<FeatureOrigin>> origins;
  double min_feature = 0;  // 0: features were not looked for
  // No value where nothing is promised: the paper's contours.
  std::optional<slicer::Deviation> deviation;
  std::uint64_t snapped_layers = 0;  // slicer::LayerWriter
  std::uint64_t warnings = 0;
  std::uint64_t output_bytes = 0;
  double wall_seconds = 0;     // of the whole run
  double earlier_seconds = 0;  // of processor time, before this run
  // --sampler, where contours are the paper's; else empty.
  std::string sampler;
};

// The whole as JSON, one key a line, ended by '\n'. Total and memory are those
// of the moment of the call.
std::string report_json(const RunReport& report);

// The same of one of several runs: a JSON object without what only the whole
// program has, its total time and memory. Ended by '}'.
std::string piece_json(const RunReport& report);

// The table of features that were found, without the last '\n'.
std::string feature_lines(const RunReport& report);

// "ring.slc: 98 layers, 810 loops, …"
std::string summary_line(const std::string& output, const RunReport& report);

}  // namespace lamina::cli
