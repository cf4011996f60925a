#pragma once
// Options that say what is written and how, for each command that makes files
// of layers from designs.

#include <string>

#include <CLI/App.hpp>

#include "compiler/design_options.h"

namespace lamina::cli {

// What --help calls Output, save -o, and --report and --min-feature; `options`
// and `export_format` outlive `app`.
void add_output_options(CLI::App& app, DesignOptions& options,
                        std::string& export_format);

// Chooses the format by --export-format or, where that is empty, by the name
// of the output, and checks what the options want against it. Throws
// UsageError.
void choose_format(DesignOptions& options, const std::string& export_format,
                   const std::string& output);

}  // namespace lamina::cli
