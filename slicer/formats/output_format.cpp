#include "slicer/formats/output_format.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/letter_case.h"

namespace lamina::slicer {
namespace {

struct Written {
  std::string_view extension;
  OutputFormat format;
};
constexpr std::array<Written, 15> kWritten = {{
    {"slc", OutputFormat::kSlc},
    {"cli", OutputFormat::kCli},
    {"svg", OutputFormat::kSvg},
    {"png", OutputFormat::kPng},
    {"sl1", OutputFormat::kSl1},
    {"zip", OutputFormat::kNanoDlp},
    {"nanodlp", OutputFormat::kNanoDlp},
    {"goo", OutputFormat::kGoo},
    {"ctb", OutputFormat::kCtb},
    {"slices.3mf", OutputFormat::kThreemf},
    {"layers.json", OutputFormat::kLayersJson},
    {"ast", OutputFormat::kAst},
    {"param", OutputFormat::kParam},
    {"echo", OutputFormat::kEcho},
    {"csg", OutputFormat::kCsg},
}};

// Formats of openscad that need a mesh, which lamina does not make, with the
// nearest that it writes.
struct Refused {
  std::string_view extension;
  std::string_view nearest;
};
constexpr std::array<Refused, 5> kRefused = {{
    {"stl", ".slc"},
    {"off", ".layers.json"},
    {"amf", ".slc"},
    {"dxf", ".svg"},
    {"3mf", ".slices.3mf, which programs that know no slices open as a box"},
}};

// Formats of resin printers that UVtools converts archives to.
constexpr std::array<std::string_view, 36> kConverted = {
    "encrypted.ctb", "gktwo.ctb", "cbddlp", "photon",  "photons", "pws",
    "pw0",           "pwx",       "pwmo",   "pwmx",    "pwms",    "pwma",
    "pwmb",          "pmx2",      "pmsq",   "pm3",     "pm3m",    "pm3n",
    "pm4n",          "pm5",       "pm5s",   "pm7",     "pwsz",    "cxdlp",
    "cxdlpv4",       "fdg",       "prz",    "xml.cws", "pm3r",    "px6s",
    "m5sp",          "pm7m",      "pm4u",   "dlp",     "dl2p",    "phz"};

constexpr std::string_view kConversion =
    "write an .sl1 file with --printer and convert it with UVtools "
    "('UVtoolsCmd convert')";

bool is_written(std::string_view extension) {
  return std::ranges::find(kWritten, extension, &Written::extension) !=
         kWritten.end();
}

bool has_extension(std::string_view name, std::string_view extension) {
  return name == extension ||
         (name.size() > extension.size() && name.ends_with(extension) &&
          name[name.size() - extension.size() - 1] == '.');
}

}  // namespace

bool is_of_layers(OutputFormat format) {
  using enum OutputFormat;
  return format != kAst && format != kParam && format != kEcho &&
         format != kCsg;
}

bool is_of_images(OutputFormat format) {
  using enum OutputFormat;
  return format == kPng || format == kSl1 || format == kNanoDlp ||
         format == kGoo || format == kCtb;
}

bool needs_one_thickness(OutputFormat format) {
  return is_of_images(format) && format != OutputFormat::kPng;
}

std::string complaint_of_printer(const std::string& printer,
                                 const std::vector<std::string>& reads) {
  if (reads.empty() || std::ranges::any_of(reads, is_written)) return {};
  if (reads.front() == "encrypted.ctb") {
    return fmt::format(
        "{} reads encrypted .ctb files only, which lamina does not write: {}",
        printer, kConversion);
  }
  return fmt::format("{} reads .{} files, which lamina does not write: {}",
                     printer, reads.front(), kConversion);
}

std::string usual_extension(const std::string& printer,
                            const std::vector<std::string>& reads) {
  for (const std::string& extension : reads) {
    if (is_written(extension)) return extension;
  }
  if (!reads.empty()) throw FileError(complaint_of_printer(printer, reads));
  return "slc";
}

std::size_t most_thickness_runs(OutputFormat format) {
  return format == OutputFormat::kSlc ? 255
                                      : std::numeric_limits<std::size_t>::max();
}

FormatChoice choose_output_format(std::string_view name) {
  const std::string lower = lower_case(name);
  for (const std::string_view extension : kConverted) {
    if (has_extension(lower, extension)) {
      return {{},
              fmt::format("lamina writes no .{}: {}", extension, kConversion),
              true};
    }
  }
  if (has_extension(lower, "gcode")) {
    return {{},
            "lamina writes no .gcode: it slices for resin and wax printers, "
            "not for filament",
            true};
  }
  for (const Written& written : kWritten) {
    if (has_extension(lower, written.extension)) {
      return {written.format, "", true};
    }
  }
  for (const Refused& refused : kRefused) {
    if (has_extension(lower, refused.extension)) {
      return {{},
              fmt::format("lamina makes layers, not meshes: it writes no .{}; "
                          "the nearest output is {}",
                          refused.extension, refused.nearest),
              true};
    }
  }
  return {{},
          fmt::format("'{}' has no extension that lamina knows (.slc .cli "
                      ".svg .png .sl1 .zip .nanodlp .goo .ctb .slices.3mf "
                      ".layers.json .csg .echo .ast .param)",
                      name),
          false};
}

std::vector<std::string> written_extensions() {
  std::vector<std::string> extensions;
  extensions.reserve(std::size(kWritten));
  for (const Written& written : kWritten) {
    extensions.emplace_back(written.extension);
  }
  return extensions;
}

bool is_named(std::string_view path, std::string_view extension) {
  return path.size() > extension.size() &&
         lower_case(path).ends_with(extension);
}

bool is_named_as_layers(std::string_view path) {
  const FormatChoice choice = choose_output_format(path);
  return choice.format && is_of_layers(*choice.format);
}

}  // namespace lamina::slicer
