#include "cli/report/finding_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"

namespace lamina::cli {
namespace {

using slicer::Finding;
using slicer::FindingKind;
using slicer::Peel;
using slicer::PrintCheck;

constexpr std::size_t kMostLines = 40;

std::string layers_text(const Finding& finding) {
  return finding.first_layer == finding.last_layer
             ? fmt::format("{}", finding.first_layer)
             : fmt::format("{}-{}", finding.first_layer, finding.last_layer);
}

// A line of the table: the greatest of all findings of a kind and a source
// line.
struct Line {
  std::size_t greatest = 0;  // index of the finding
  std::size_t count = 0;
};

double weight_of(const Finding& finding) {
  switch (finding.kind) {
    case FindingKind::kIsland:
      return finding.area;
    case FindingKind::kOverhang:
      return finding.distance;
    default:
      return finding.volume;
  }
}

// By kind, then from the bottom to the top.
std::vector<Line> lines_of(const std::vector<Finding>& findings,
                           std::span<const std::string> source_lines) {
  std::vector<Line> lines;
  std::map<std::pair<FindingKind, std::string_view>, std::size_t> known;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (findings[i].is_minor) continue;
    if (source_lines.empty() || source_lines[i].empty()) {
      lines.push_back({i, 1});
      continue;
    }
    const auto [at, is_new] =
        known.try_emplace({findings[i].kind, source_lines[i]}, lines.size());
    if (is_new) lines.push_back({i});
    Line& line = lines[at->second];
    ++line.count;
    if (weight_of(findings[i]) > weight_of(findings[line.greatest])) {
      line.greatest = i;
    }
  }
  std::ranges::stable_sort(lines, {}, [&](const Line& line) {
    return findings[line.greatest].kind;
  });
  return lines;
}

}  // namespace

std::string finding_counts(const PrintCheck& print) {
  std::string text;
  for (std::size_t i = 0; i < slicer::kFindingKinds; ++i) {
    const auto kind = static_cast<FindingKind>(i);
    const std::size_t count = print.count(kind);
    if (count == 0) continue;
    text += fmt::format("{}{}", text.empty() ? "" : ", ",
                        counted(count, name_of(kind)));
  }
  if (text.empty()) text = "nothing found";
  if (const std::size_t minor = print.count_minor()) {
    text += fmt::format(" ({} too small to matter)", minor);
  }
  return text;
}

std::string finding_table(const PrintCheck& print,
                          std::span<const std::string> source_lines) {
  const std::vector<Finding>& findings = print.findings;
  std::string text = fmt::format("print: {}\n", finding_counts(print));
  const auto out = std::back_inserter(text);
  const std::vector<Line> lines = lines_of(findings, source_lines);
  if (!lines.empty()) {
    fmt::format_to(out, "{:>15} {:>11} {:>10} {:>10} {:>10}  {}\n", "",
                   "layers", "at z", "x", "y", "size");
  }
  const std::size_t listed = std::min(lines.size(), kMostLines);
  for (const Line& line : std::span(lines).first(listed)) {
    const Finding& finding = findings[line.greatest];
    fmt::format_to(out, "{:>15} {:>11} {:>10.4f} {:>10.4f} {:>10.4f}  {}",
                   counted(line.count, name_of(finding.kind)),
                   layers_text(finding), finding.section_z, finding.place.x,
                   finding.place.y, size_text(finding));
    if (!source_lines.empty() && !source_lines[line.greatest].empty()) {
      fmt::format_to(out, ", by {}", source_lines[line.greatest]);
    }
    text += '\n';
  }
  if (lines.size() > listed) {
    fmt::format_to(out, "  … and {}\n",
                   counted(lines.size() - listed, "more line"));
  }
  if (print.peel.layer > 0) {
    fmt::format_to(out, "peel: {:.4g} mm² at most, in layer {}",
                   print.peel.greatest_area, print.peel.layer);
    if (print.peel.jump_layer > 0) {
      fmt::format_to(out, "; {:.4g} mm² more than before in layer {}",
                     print.peel.greatest_jump, print.peel.jump_layer);
    }
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json finding_json(const Finding& finding) {
  nlohmann::ordered_json json = {{"kind", name_of(finding.kind)},
                                 {"is_minor", finding.is_minor},
                                 {"first_layer", finding.first_layer},
                                 {"last_layer", finding.last_layer},
                                 {"bottom", finding.bottom},
                                 {"top", finding.top},
                                 {"layer", finding.layer},
                                 {"z", finding.section_z},
                                 {"x", finding.place.x},
                                 {"y", finding.place.y},
                                 {"area_mm2", finding.area}};
  switch (finding.kind) {
    case FindingKind::kIsland:
      json["is_joined"] = finding.is_joined;
      break;
    case FindingKind::kOverhang:
      json["distance_mm"] = finding.distance;
      break;
    default:
      json["volume_mm3"] = finding.volume;
  }
  if (!finding.box.is_empty()) {
    const auto& [low, high] = finding.box;
    json["low"] = {low.x, low.y, low.z};
    json["high"] = {high.x, high.y, high.z};
  }
  return json;
}

nlohmann::ordered_json peel_json(const Peel& peel) {
  return {{"greatest_area_mm2", peel.greatest_area},
          {"layer", peel.layer},
          {"greatest_jump_mm2", peel.greatest_jump},
          {"jump_layer", peel.jump_layer}};
}

}  // namespace lamina::cli
