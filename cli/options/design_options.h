#pragma once
// The options that make up the request for a compilation.

#include <string>

#include <CLI/App.hpp>

#include "compiler/request.h"

namespace lamina::cli {

// Adds -D, -p, -P, the other options of the language, and -q. `request` and
// `is_quiet` outlive `app`.
void add_design_options(CLI::App& app, compiler::Request& request,
                        bool& is_quiet);

// Adds the options that --help calls Slicing.
void add_slicing_options(CLI::App& app, compiler::Request& request);

// The group of CLI11 of those among them that change layers: files of layers
// have no use for these. (--threads and limits of a run harm nobody.)
inline constexpr const char* kDesignGroup = "Design";

// Notes in the request the first option of that group that was given. `request`
// outlives `app`.
void note_design_option(CLI::App& app, compiler::Request& request);

struct OutputOptions {
  std::string export_format;  // empty: the output's name says it
  std::string report;         // path; empty: none
};

// Adds --printer and --material. `request` outlives `app`.
void add_machine_options(CLI::App& app, compiler::Request& request);

// Adds the options that say what is written and how: those that --help calls
// Output, save -o, and --report, --layers and --min-feature. `request` and
// `options` outlive `app`.
void add_output_options(CLI::App& app, compiler::Request& request,
                        OutputOptions& options);

// Chooses the format by --export-format or, where that is empty, by the name
// of the output, and checks what else is asked for against it. Throws
// RequestError.
void choose_format(compiler::Request& request, const OutputOptions& options,
                   const std::string& output);

}  // namespace lamina::cli
