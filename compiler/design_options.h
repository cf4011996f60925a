#pragma once
// What a run over a design is asked for, and the options that say so.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <CLI/App.hpp>

#include "csg/eval/evaluator.h"
#include "slicer/formats/output_format.h"
#include "slicer/slice/settings.h"

namespace lamina::cli {

// Of --axis: the program chooses.
inline constexpr std::string_view kAutomaticAxis = "auto";

// From a design to layers, or to one of the stages on the way.
struct DesignOptions {
  std::string design;
  std::string output;  // "-": standard output
  slicer::OutputFormat format = slicer::OutputFormat::kSlc;
  std::optional<slicer::CliEncoding> cli_encoding;
  std::string printer;     // name or profile of its panel; empty: the format's
  bool mirrors_x = false;  // the image
  bool mirrors_y = false;
  std::string definitions;     // of all -D, as text: "a=1;\nb=2;\n"
  std::string parameter_file;  // -p; empty: none
  std::string parameter_set;   // -P
  std::string axis = "z";      // of slicer::kAxes, or kAutomaticAxis
  bool is_placed_on_bed = false;
  double scale = 1;
  double chordal_error = 0;  // [mm]; 0: $fa and $fs decide
  slicer::Settings settings;
  std::uint32_t seed = 0;
  bool checks_parameters = true;
  bool checks_parameter_ranges = false;
  std::uint32_t max_depth = csg::EvaluateOptions().max_depth;
  std::uint32_t max_leaves = csg::EvaluateOptions().max_leaves;
  // openscad's modes of --render and --preview; empty: not given. Which one it
  // is shows in nothing but $preview.
  std::string render;
  std::string preview;
  std::string dependencies;  // -d, path; empty: none
  std::string report;        // path; empty: none
  bool is_quiet = false;
  bool has_hard_warnings = false;
};

// -D, -p, -P and what else the language has; `options` outlives `app`.
void add_design_options(CLI::App& app, DesignOptions& options);

// What --help calls Slicing.
void add_slicing_options(CLI::App& app, DesignOptions& options);

}  // namespace lamina::cli
