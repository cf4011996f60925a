#pragma once
// The options that say what a compilation is asked for.

#include <CLI/App.hpp>

#include "compiler/request.h"

namespace lamina::cli {

// -D, -p, -P and what else the language has, and -q; `request` and `is_quiet`
// outlive `app`.
void add_design_options(CLI::App& app, compiler::Request& request,
                        bool& is_quiet);

// What --help calls Slicing.
void add_slicing_options(CLI::App& app, compiler::Request& request);

}  // namespace lamina::cli
