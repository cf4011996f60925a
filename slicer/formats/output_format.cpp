#include "slicer/formats/output_format.h"

#include <array>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "base/letter_case.h"

namespace lamina::slicer {
namespace {

struct Written {
  std::string_view extension;
  OutputFormat format;
};
constexpr std::array<Written, 13> kWritten = {{
    {"slc", OutputFormat::kSlc},
    {"cli", OutputFormat::kCli},
    {"svg", OutputFormat::kSvg},
    {"png", OutputFormat::kPng},
    {"sl1", OutputFormat::kSl1},
    {"zip", OutputFormat::kNanoDlp},
    {"nanodlp", OutputFormat::kNanoDlp},
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
  return format == kPng || format == kSl1 || format == kNanoDlp;
}

std::size_t most_thickness_runs(OutputFormat format) {
  return format == OutputFormat::kSlc ? 255
                                      : std::numeric_limits<std::size_t>::max();
}

FormatChoice choose_output_format(std::string_view name) {
  const std::string lower = lower_case(name);
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
                      ".svg .png .sl1 .zip .nanodlp .slices.3mf .layers.json "
                      ".csg .echo .ast "
                      ".param)",
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
