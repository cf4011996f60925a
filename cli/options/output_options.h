#pragma once
// Options that say what is written and how, for each command that makes files
// of layers from designs.

#include <string>

#include <CLI/App.hpp>

#include "compiler/request.h"

namespace lamina::cli {

struct OutputOptions {
  std::string export_format;  // empty: the output's name says it
  std::string report;         // path; empty: none
};

// Adds the options that --help calls Output, save -o, and --report, --layers
// and
// --min-feature. `request` and `options` outlive `app`.
void add_output_options(CLI::App& app, compiler::Request& request,
                        OutputOptions& options);

// Chooses the format by --export-format or, where that is empty, by the name
// of the output, and checks what else is asked for against it. Throws
// UsageError.
void choose_format(compiler::Request& request, const OutputOptions& options,
                   const std::string& output);

}  // namespace lamina::cli
