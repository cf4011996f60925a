#pragma once
// The options that make up the request for a compilation.

#include <string>

#include "cli/options/option_list.h"
#include "compiler/request.h"

namespace lamina::cli {

// Adds -D, -p, -P, the other options of the language, and -q. `request` and
// `is_quiet` outlive the list.
void add_design_options(OptionList& options, compiler::Request& request,
                        bool& is_quiet);

// Adds --chordal-error and --decimate, which say how many facets there are, and
// --threads.
void add_facet_options(OptionList& options, compiler::Request& request);

void add_sprue_option(OptionList& options, compiler::Request& request);

// Adds the options that --help calls Slicing, those among them.
void add_slicing_options(OptionList& options, compiler::Request& request);

// Throws RequestError where a file holds layers: a design was expected.
void refuse_layers(const std::string& file);

// The group of those among them that change layers: files of layers
// have no use for these. (--threads and limits of a run harm nobody.)
inline constexpr const char* kDesignGroup = "Design";

// Notes in the request the first option of that group that was given. `request`
// outlives `options`.
void note_design_option(OptionList& options, compiler::Request& request);

struct OutputOptions {
  std::string export_format;  // empty: the output's name says it
  std::string report;         // path; empty: none
};

// Adds --printer and --material. `request` outlives `options`.
void add_machine_options(OptionList& options, compiler::Request& request);

// Adds --min-feature, --self-supporting and --fail-on. `request` outlives
// `options`.
void add_print_options(OptionList& options, compiler::Request& request);

// Binds --strict and --no-strict, which add_output_options() has, too.
void add_strict_options(OptionList& options, compiler::Request& request);

// Adds the options that say what is written and how: those that --help calls
// Output, save -o, and --report, --layers and those of the print. `request` and
// `output` outlive the list.
void add_output_options(OptionList& options, compiler::Request& request,
                        OutputOptions& output);

// The extension of an output that has none: --export-format, or what a printer
// that lamina knows reads. Throws FileError where lamina writes nothing that
// this printer reads.
std::string usual_extension(const compiler::Request& request,
                            const OutputOptions& options);

// The name of the output, with that extension where it has none and a printer
// is named.
std::string with_extension(const compiler::Request& request,
                           const OutputOptions& options);

// Chooses the format by --export-format or, where that is empty, by the name
// of the output, and checks what else is asked for against it. Throws
// RequestError.
void choose_format(compiler::Request& request, const OutputOptions& options,
                   const std::string& output);

}  // namespace lamina::cli
