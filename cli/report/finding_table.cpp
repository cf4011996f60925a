#include "cli/report/finding_table.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "base/utf8.h"

namespace lamina::cli {
namespace {

using slicer::Finding;
using slicer::FindingKind;
using slicer::Peel;
using slicer::PrintCheck;

// Rows of a kind; what is left shares one more.
constexpr std::size_t kMostRows = 5;

// A row of the table: findings of a kind and a source line, or those that are
// left.
struct Row {
  const Finding* greatest = nullptr;
  std::string_view source_line;
  std::uint32_t first_layer = 0;
  std::uint32_t last_layer = 0;
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

void add_to(Row& row, const Row& other) {
  if (row.count == 0 || weight_of(*other.greatest) > weight_of(*row.greatest)) {
    row.greatest = other.greatest;
  }
  row.first_layer = row.count == 0
                        ? other.first_layer
                        : std::min(row.first_layer, other.first_layer);
  row.last_layer = std::max(row.last_layer, other.last_layer);
  row.count += other.count;
}

// One for each source line; where that is not known, for each finding.
std::vector<Row> rows_of(FindingKind kind, const std::vector<Finding>& findings,
                         std::span<const std::string> source_lines) {
  std::vector<Row> rows;
  std::map<std::string_view, std::size_t> known;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding& finding = findings[i];
    if (finding.is_minor || finding.kind != kind) continue;
    const std::string_view line =
        source_lines.empty() ? "" : std::string_view(source_lines[i]);
    std::size_t at = rows.size();
    if (!line.empty()) at = known.try_emplace(line, at).first->second;
    if (at == rows.size()) rows.push_back({.source_line = line});
    add_to(rows[at],
           {&finding, line, finding.first_layer, finding.last_layer, 1});
  }
  std::ranges::stable_sort(rows, std::greater<>(), [](const Row& row) {
    return weight_of(*row.greatest);
  });
  return rows;
}

// The worst rows, and one of all others.
std::vector<Row> shortened(std::vector<Row> rows) {
  if (rows.size() <= kMostRows + 1) return rows;
  Row rest;
  for (const Row& row : std::span(rows).subspan(kMostRows)) add_to(rest, row);
  rows.resize(kMostRows);
  rows.push_back(rest);
  return rows;
}

void append_row(const Row& row, std::string& text) {
  constexpr std::size_t kWidest = 80;
  const Finding& worst = *row.greatest;
  const std::string layers =
      row.first_layer == row.last_layer
          ? fmt::format("{}", row.first_layer)
          : fmt::format("{}-{}", row.first_layer, row.last_layer);
  const std::string size =
      row.count == 1 ? size_text(worst)
                     : fmt::format("greatest in {}: {}", worst.first_layer,
                                   size_text(worst));
  const Vec3 at = in_hundredths(Vec3(worst.place, worst.section_z));
  const std::string place =
      fmt::format("{:>15} {:>9} {:>8.3f} {:>8.2f} {:>8.2f}",
                  counted(row.count, name_of(worst.kind)), layers,
                  worst.section_z, at.x, at.y);
  const bool is_wide = utf8_width(place) + utf8_width(size) + 2 > kWidest;
  text += is_wide ? fmt::format("{}\n      {}\n", place, size)
                  : fmt::format("{}  {}\n", place, size);
  if (!row.source_line.empty()) {
    text += fmt::format("      by {}\n", row.source_line);
  }
}

}  // namespace

std::string finding_counts(const PrintCheck& print) {
  std::string text = print.counts(slicer::kAllFindings);
  if (text.empty()) text = "no problems found";
  if (const std::size_t minor = print.count_minor()) {
    text += fmt::format(" ({} too small to matter)", minor);
  }
  return text;
}

std::string finding_table(const PrintCheck& print,
                          std::span<const std::string> source_lines) {
  // The worst first: what is lost, what may fail, what needs a support.
  constexpr std::array<FindingKind, slicer::kFindingKinds> kBySeverity = {
      FindingKind::kLoosePart, FindingKind::kIsland, FindingKind::kResinTrap,
      FindingKind::kSuctionCup, FindingKind::kOverhang};
  std::string text = fmt::format("print: {}\n", finding_counts(print));
  const auto out = std::back_inserter(text);
  bool has_head = false;
  for (const FindingKind kind : kBySeverity) {
    for (const Row& row :
         shortened(rows_of(kind, print.findings, source_lines))) {
      if (!has_head) {
        fmt::format_to(out, "{:>15} {:>9} {:>8} {:>8} {:>8}  {}\n", "",
                       "layers", "at z", "x", "y", "size");
      }
      has_head = true;
      append_row(row, text);
    }
  }
  if (print.peel.layer > 0) {
    fmt::format_to(out, "peel: largest cured area {:.4g} mm² (layer {})",
                   print.peel.greatest_area, print.peel.layer);
    if (print.peel.jump_layer > 0) {
      fmt::format_to(out, ", largest jump {:.4g} mm² (layer {})",
                     print.peel.greatest_jump, print.peel.jump_layer);
    }
    text += '\n';
  }
  return text;
}

std::string contact_table(
    const std::optional<slicer::SupportMeasures>& supports,
    std::span<const std::string> source_lines) {
  if (!supports) return {};
  std::string text = fmt::format("supports: {}\n", size_text(*supports));
  struct Touched {
    double area = 0;
    std::size_t places = 0;
  };
  std::map<std::string_view, Touched> by_line;
  for (std::size_t i = 0; i < source_lines.size(); ++i) {
    Touched& touched =
        by_line[source_lines[i].empty() ? "lines that are not known"
                                        : std::string_view(source_lines[i])];
    touched.area += supports->contacts[i].area;
    ++touched.places;
  }
  std::vector<std::pair<std::string_view, Touched>> rows(by_line.begin(),
                                                         by_line.end());
  std::ranges::stable_sort(rows, std::greater<>(),
                           [](const auto& row) { return row.second.area; });
  for (const auto& [line, touched] : rows) {
    text += fmt::format("{:>9.3f} mm² at {} of {}\n", touched.area,
                        counted(touched.places, "place"), line);
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
      json["is_weak"] = finding.is_weak();
      json["bond"] = finding.bond;
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
