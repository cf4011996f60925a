#pragma once
// The output that a file name's extension asks for, the same in every command.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::slicer {

enum class OutputFormat {
  kSlc,
  kCli,
  kSvg,
  kPng,  // a folder of images
  kSl1,
  kNanoDlp,
  kGoo,
  kCtb,
  kThreemf,
  kLayersJson,
  kAst,    // the parser's product
  kParam,  // the parameters of the customizer
  kEcho,   // what the design prints
  kCsg,    // the evaluator's product
};

enum class CliEncoding { kBinary, kAscii };

// Whether the format holds layers, not the product of a stage before them.
bool is_of_layers(OutputFormat format);

// Whether its layers are images for a panel.
bool is_of_images(OutputFormat format);

// Runs of layers of equal thickness that a file of the format can hold, at
// most. Each is a row of SLC's table, which counts its rows in one byte.
std::size_t most_thickness_runs(OutputFormat format);

// What a file name or an `--export-format` asks for.
struct FormatChoice {
  std::optional<OutputFormat> format;
  // Without a format: the reason, for the user. `is_known` is then true for a
  // format that lamina knows but does not write.
  std::string complaint;
  bool is_known = false;
};

// name  a path ("out/ring.slc") or a bare extension ("slc"); letter case does
//       not matter
FormatChoice choose_output_format(std::string_view name);

// Whether layers must have one thickness, which the file says once.
bool needs_one_thickness(OutputFormat format);

// The extension of what a printer of these formats gets where nothing else is
// asked for: that of the first one that lamina writes, "slc" where none is
// known. Throws FileError where lamina writes none of them.
//
// printer  its title, for the message
// reads    Printer::reads
std::string usual_extension(const std::string& printer,
                            const std::vector<std::string>& reads);

// What to do instead for a printer that reads none of the formats that lamina
// writes; empty for all others.
std::string complaint_of_printer(const std::string& printer,
                                 const std::vector<std::string>& reads);

// The extensions that ask for a format, "slc" to "csg".
std::vector<std::string> written_extensions();

// Whether a path ends with an extension such as ".layers.json", in any letter
// case; `extension` is in small letters.
bool is_named(std::string_view path, std::string_view extension);

// Whether a path has the name of a file of layers, not of a design.
bool is_named_as_layers(std::string_view path);

}  // namespace lamina::slicer
