#pragma once
// The options that make up the request for a compilation.

#include <CLI/App.hpp>

#include "compiler/request.h"

namespace lamina::cli {

// Adds -D, -p, -P, the other options of the language, and -q. `request` and
// `is_quiet` outlive `app`.
void add_design_options(CLI::App& app, compiler::Request& request,
                        bool& is_quiet);

// Adds the options that --help calls Slicing.
void add_slicing_options(CLI::App& app, compiler::Request& request);

}  // namespace lamina::cli
