#include "compiler/report.h"

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <time.h>

#include "slicer/check/feature_table.h"

namespace lamina::cli {
namespace {

std::string memory_text(std::uint64_t bytes) {
  if (bytes >= 1'000'000) {
    return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
  }
  return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
}

// null where nothing is known.
std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "null";
}

// The certificate: how far contours can be from what the design says.
std::string deviation_json(const std::optional<slicer::Deviation>& deviation) {
  if (!deviation) return "null";
  return fmt::format(
      "{{\"from_section\": {}, \"from_curves\": {}, \"ties\": {}, "
      "\"columns\": {}, \"compensation\": {}, \"simplification\": {}, "
      "\"rounding\": {}, "
      "\"facets\": {}}}",
      deviation->from_section(), number(deviation->from_curves()),
      deviation->ties, deviation->columns, deviation->compensation,
      deviation->simplification, deviation->rounding,
      number(deviation->facets));
}

// 0 where the system does not tell. What getrusage tells instead counts the
// caller's pages too, from between fork and exec.
std::uint64_t peak_of_address_space() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  return 0;
}

// An object of JSON, one key a line.
class JsonObject {
 public:
  // value  a number, or a text that is JSON itself
  template <typename Value>
  void add(std::string_view key, const Value& value) {
    fmt::format_to(std::back_inserter(members_), "{}  \"{}\": {}",
                   members_.empty() ? "" : ",\n", key, value);
  }

  std::string text() const { return fmt::format("{{\n{}\n}}", members_); }

 private:
  std::string members_;
};

// What only the paper's contours have.
void add_paper(const RunReport& report, JsonObject& json) {
  const ldni::PaperCounts& paper = report.slice.paper;
  json.add("sampler", nlohmann::json(report.sampler).dump());
  json.add("renderer", nlohmann::json(report.slice.renderer).dump());
  json.add("boolean_seconds", paper.boolean_seconds);
  json.add("link_seconds", paper.link_seconds);
  json.add("image_intervals", paper.intervals);
  json.add("repaired_pixels", paper.repaired_pixels);
}

void add_passes(const RunReport& report, JsonObject& json) {
  const slicer::SliceReport& slice = report.slice;
  json.add("load_seconds", report.load_seconds);
  json.add("evaluate_seconds", report.evaluate_seconds);
  json.add("lower_seconds", report.lower_seconds);
  json.add("section_seconds", slice.section_seconds);
  json.add("sweep_seconds", slice.sweep_seconds);
  json.add("feature_seconds", slice.feature_seconds);
  json.add("output_seconds", slice.output_seconds);
}

void add_layers(const RunReport& report, JsonObject& json) {
  const slicer::SliceReport& slice = report.slice;
  json.add("layers", slice.layers);
  json.add("loops", slice.loops);
  json.add("holes", slice.holes);
  json.add("points", slice.points);
  json.add("volume_mm3", slice.volume);
  json.add("greatest_area_mm2", slice.greatest_area);
  json.add("chains", slice.sweep.chains);
  json.add("chain_points", slice.sweep.points);
  json.add("slabs", slice.sweep.slabs);
  json.add("event_points", slice.sweep.event_points);
  json.add("evaluations", slice.sweep.evaluations);
  json.add("resolved_layers", slice.sweep.resolved_layers);
  json.add("image_pixels", slice.paper.pixels);
  json.add("image_samples", slice.paper.samples);
  json.add("image_bytes", slice.paper.image_bytes());
  json.add("vanished_regions", slice.losses.vanished_regions);
  json.add("vanished_holes", slice.losses.vanished_holes);
  json.add("broken_walls", slice.losses.broken_walls);
  json.add("closed_gaps", slice.losses.closed_gaps);
  json.add("open_paths", slice.open_paths);
  json.add("unbalanced_clusters", slice.sweep.unbalanced_clusters);
  json.add("repaired_clusters", slice.sweep.repaired_clusters);
  json.add("capped_clusters", slice.sweep.capped_clusters);
  json.add("snapped_layers", report.snapped_layers);
  json.add("warnings", report.warnings);
  json.add("deviation_mm", deviation_json(report.deviation));
  if (!report.sampler.empty()) add_paper(report, json);
  if (report.min_feature > 0) {
    json.add("min_feature_mm", report.min_feature);
    json.add("features",
             features_json(slice.features, report.min_feature, report.origins));
  }
}

}  // namespace

double process_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

std::uint64_t peak_memory_bytes() {
  if (const std::uint64_t bytes = peak_of_address_space()) return bytes;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string report_json(const RunReport& report) {
  JsonObject json;
  add_passes(report, json);
  json.add("total_seconds", process_seconds() - report.earlier_seconds);
  json.add("wall_seconds", report.wall_seconds);
  json.add("peak_memory_bytes", peak_memory_bytes());
  add_layers(report, json);
  return json.text() + "\n";
}

std::string piece_json(const RunReport& report) {
  JsonObject json;
  add_passes(report, json);
  json.add("wall_seconds", report.wall_seconds);
  add_layers(report, json);
  return json.text();
}

std::string feature_lines(const RunReport& report) {
  std::string lines = slicer::feature_table(
      report.slice.features, report.min_feature, origin_texts(report.origins));
  lines.pop_back();
  return lines;
}

std::string summary_line(const std::string& output, const RunReport& report) {
  const slicer::SliceReport& slice = report.slice;
  return fmt::format(
      "{}: {} layers, {} loops, {} vertices, {}\n"
      "{:.3f} s of processor time (load {:.3f}, evaluate {:.3f}, lower {:.3f}, "
      "sections {:.3f}, sweep {:.3f}, output {:.3f}), {} of memory, {:.3f} s "
      "by the clock",
      output == "-" ? "standard output" : output, slice.layers, slice.loops,
      slice.points, memory_text(report.output_bytes),
      process_seconds() - report.earlier_seconds, report.load_seconds,
      report.evaluate_seconds, report.lower_seconds, slice.section_seconds,
      slice.sweep_seconds, slice.output_seconds,
      memory_text(peak_memory_bytes()), report.wall_seconds);
}

}  // namespace lamina::cli
