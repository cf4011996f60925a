#include "compiler/source_lines.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/text.h"

namespace lamina::compiler {
namespace {

std::string place_of(const SourceRange& range) {
  if (!range.is_known()) return {};
  const std::string path = on_one_line(shown_path(range.source->path()));
  if (!range.is_written()) return path;
  const LineColumn at = range.source->line_column(range.begin);
  return fmt::format("{}:{}:{}", path, at.line, at.column);
}

std::string text_of(const SourceLine& line) {
  if (line.calls.empty()) return line.place;
  return fmt::format("{} from {}", line.place, line.calls.back().place);
}

SourceLine line_of(const csg::Instance& instance) {
  SourceLine line;
  line.place = place_of(instance.range);
  for (const csg::CallSite* call = instance.caller; call != nullptr;
       call = call->caller) {
    line.calls.push_back({std::string(call->name), place_of(call->range)});
  }
  return line;
}

// "ring.scad:12:3", from a folder; a file that is far from there by its name
// alone.
std::string place_from(const std::string& folder, const std::string& place) {
  std::size_t end = place.size();
  for (int i = 0; i < 2; ++i) {
    const std::size_t digits = place.find_last_not_of("0123456789", end - 1);
    if (digits == std::string::npos || place[digits] != ':') break;
    end = digits;
  }
  std::string path = relative_path(path_of_shown(place.substr(0, end)), folder);
  if (path.starts_with("../../")) {
    path = std::filesystem::path(path).filename().string();
  }
  return path + place.substr(end);
}

}  // namespace

SourceLines lines_of(const csg::Scene& scene, std::uint32_t a,
                     std::uint32_t b) {
  SourceLines lines;
  for (const std::uint32_t instance : {std::min(a, b), std::max(a, b)}) {
    if (instance == slicer::kNoInstance) continue;
    SourceLine line = line_of(scene.instances[instance]);
    if (lines.empty() || text_of(lines[0]) != text_of(line)) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

FoundLines find_lines(const csg::Lowered& lowered,
                      const slicer::SliceReport& report) {
  FoundLines found;
  const csg::Scene* const scene = lowered.scene();
  if (scene == nullptr) return found;
  for (const slicer::ThinFeature& feature : report.features) {
    found.features.push_back(
        lines_of(*scene, feature.instances[0], feature.instances[1]));
  }
  if (report.supports) {
    for (const auto& contact : report.supports->contacts) {
      found.contacts.push_back(
          lines_of(*scene, contact.instance, slicer::kNoInstance));
    }
  }
  if (!report.print) return found;
  for (const slicer::Finding& finding : report.print->findings) {
    found.findings.push_back(
        lines_of(*scene, finding.instance, slicer::kNoInstance));
  }
  return found;
}

std::string line_text(const csg::Instance& instance) {
  return text_of(line_of(instance));
}

std::string text_of(const SourceLines& lines) {
  std::string text;
  for (const SourceLine& line : lines) {
    if (!text.empty()) text += ", ";
    text += text_of(line);
  }
  return text;
}

std::string text_from(const std::string& folder, SourceLines lines) {
  for (SourceLine& line : lines) {
    line.place = place_from(folder, line.place);
    for (auto& call : line.calls) call.place = place_from(folder, call.place);
  }
  return text_of(lines);
}

std::vector<std::string> texts_of(std::span<const SourceLines> all) {
  std::vector<std::string> texts;
  for (const SourceLines& lines : all) texts.push_back(text_of(lines));
  return texts;
}

}  // namespace lamina::compiler
