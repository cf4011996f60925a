#include "cli/report/feature_table.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"

namespace lamina::cli {
namespace {

using slicer::ThinFeature;
using slicer::ThinKind;

std::string layers_text(const ThinFeature& feature) {
  return feature.first_layer == feature.last_layer
             ? fmt::format("{}", feature.first_layer)
             : fmt::format("{}-{}", feature.first_layer, feature.last_layer);
}

std::string counts_text(std::span<const ThinFeature* const> features) {
  const auto walls = static_cast<std::size_t>(
      std::ranges::count(features, ThinKind::kWall, &ThinFeature::kind));
  return fmt::format("{}, {}", counted(walls, "wall"),
                     counted(features.size() - walls, "gap"));
}

// A line of the table: the thinnest of all features of one source line.
struct Line {
  const ThinFeature* thinnest;
  std::size_t count = 0;
};

// A line for each kind and source line, or for each feature where they are not
// known; the thinnest first.
std::vector<Line> lines_of(std::span<const ThinFeature* const> tall,
                           const ThinFeature* first,
                           std::span<const std::string> source_lines) {
  std::vector<Line> lines;
  std::map<std::tuple<ThinKind, bool, std::string_view>, std::size_t> known;
  for (const ThinFeature* const feature : tall) {
    if (source_lines.empty()) {
      lines.push_back({feature, 1});
      continue;
    }
    const auto [at, is_new] = known.try_emplace(
        {feature->kind, is_edge(*feature),
         source_lines[static_cast<std::size_t>(feature - first)]},
        lines.size());
    if (is_new) lines.push_back({feature});
    Line& line = lines[at->second];
    ++line.count;
    if (feature->width < line.thinnest->width) line.thinnest = feature;
  }
  std::ranges::stable_sort(
      lines, {}, [](const Line& line) { return rank_of(*line.thinnest); });
  return lines;
}

}  // namespace

std::string feature_table(std::span<const ThinFeature> features, double width,
                          std::span<const std::string> source_lines) {
  std::vector<const ThinFeature*> tall;
  std::vector<const ThinFeature*> low;
  for (const ThinFeature& feature : features) {
    (is_low(feature, width) ? low : tall).push_back(&feature);
  }
  std::string text =
      fmt::format("thinner than {} mm: {}\n", width, counts_text(tall));
  const auto out = std::back_inserter(text);
  const std::vector<Line> lines = lines_of(tall, features.data(), source_lines);
  if (!lines.empty()) {
    fmt::format_to(out, "{:>9} {:>8} {:>11} {:>10} {:>10} {:>10}{}\n",
                   "width mm", "", "layers", "at z", "x", "y",
                   source_lines.empty() ? "" : "  surface of");
  }
  const std::size_t listed = std::min(lines.size(), kMostLines);
  for (const Line& line : std::span(lines).first(listed)) {
    const ThinFeature& feature = *line.thinnest;
    fmt::format_to(
        out, "{:>9} {:>8} {:>11} {:>10.4f} {:>10.4f} {:>10.4f}",
        is_edge(feature) ? "edge" : fmt::format("{:.4f}", feature.width),
        counted(line.count, name_of(feature.kind)), layers_text(feature),
        feature.section_z, feature.place.x, feature.place.y);
    if (!source_lines.empty()) {
      fmt::format_to(
          out, "  {}",
          source_lines[static_cast<std::size_t>(&feature - features.data())]);
    }
    text += '\n';
  }
  if (lines.size() > listed) {
    fmt::format_to(out, "  … and {} more lines\n", lines.size() - listed);
  }
  if (!low.empty()) {
    fmt::format_to(out, "not listed: {} less than {} mm high\n",
                   counts_text(low), width);
  }
  return text;
}

}  // namespace lamina::cli
