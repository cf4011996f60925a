#include "cli/report/run_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <time.h>

#include "base/child_process.h"
#include "base/file/output_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/process/exit_status.h"
#include "cli/report/feature_table.h"
#include "cli/report/finding_table.h"
#include "compiler/compile.h"
#include "compiler/orient.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string memory_text(std::uint64_t bytes) {
  if (bytes >= 1'000'000) {
    return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
  }
  return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
}

// 0 where the system does not say. What getrusage says instead counts the
// caller's pages too, from between fork and exec.
std::uint64_t peak_of_address_space() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  return 0;
}

// Whole numbers without ".0"; null where nothing is known.
Json number(const std::optional<double>& value) {
  constexpr double kMost = 1e15;  // whole numbers below it are exact
  if (!value) return nullptr;
  if (*value != std::floor(*value) || std::abs(*value) >= kMost) return *value;
  return static_cast<std::int64_t>(*value);
}

// The certificate: how far contours can be from what the design says.
Json deviation_json(const std::optional<slicer::Deviation>& deviation) {
  if (!deviation) return nullptr;
  return {{"from_section", number(deviation->from_section())},
          {"from_curves", number(deviation->from_curves())},
          {"ties", number(deviation->ties)},
          {"clusters", number(deviation->clusters)},
          {"compensation", number(deviation->compensation)},
          {"simplification", number(deviation->simplification)},
          {"rounding", number(deviation->rounding)},
          {"facets", number(deviation->facets)}};
}

Json lines_json(const compiler::SourceLines& lines) {
  Json json = Json::array();
  for (const compiler::SourceLine& line : lines) {
    Json calls = Json::array();
    for (const compiler::SourceLine::Call& call : line.calls) {
      calls.push_back({{"module", call.module}, {"place", call.place}});
    }
    json.push_back({{"place", line.place}, {"called_by", std::move(calls)}});
  }
  return json;
}

Json feature_json(const slicer::ThinFeature& feature, double width) {
  return {{"kind", slicer::name_of(feature.kind)},
          {"width_mm", feature.width},
          {"first_layer", feature.first_layer},
          {"last_layer", feature.last_layer},
          {"bottom", feature.bottom},
          {"top", feature.top},
          {"is_low", slicer::is_low(feature, width)},
          {"layer", feature.layer},
          {"z", feature.section_z},
          {"x", feature.place.x},
          {"y", feature.place.y},
          {"low", {feature.low.x, feature.low.y}},
          {"high", {feature.high.x, feature.high.y}}};
}

Json features_json(const compiler::Report& report, double width) {
  Json json = Json::array();
  for (std::size_t i = 0; i < report.slice.features.size(); ++i) {
    Json& feature =
        json.emplace_back(feature_json(report.slice.features[i], width));
    feature["made_by"] = i < report.lines.features.size()
                             ? lines_json(report.lines.features[i])
                             : Json::array();
  }
  return json;
}

// Planning cuts the scene, too.
double section_seconds(const compiler::Report& report) {
  return report.plan_seconds + report.slice.section_seconds;
}

Json passes_json(const compiler::Report& report) {
  const slicer::SliceReport& slice = report.slice;
  return {{"load_seconds", number(report.load_seconds)},
          {"evaluate_seconds", number(report.evaluate_seconds)},
          {"lower_seconds", number(report.lower_seconds)},
          {"section_seconds", number(section_seconds(report))},
          {"sweep_seconds", number(slice.sweep_seconds)},
          {"feature_seconds", number(slice.feature_seconds)},
          {"graph_seconds", number(slice.graph_seconds)},
          {"output_seconds", number(slice.output_seconds)}};
}

Json layers_json(const compiler::Report& report) {
  const slicer::SliceReport& slice = report.slice;
  return {{"layers", slice.layers},
          {"loops", slice.loops},
          {"holes", slice.holes},
          {"points", slice.points},
          {"volume_mm3", number(slice.volume)},
          {"greatest_area_mm2", number(slice.greatest_area)},
          {"box_mm", box_json(slice.box)},
          {"chains", slice.sweep.chains},
          {"chain_points", slice.sweep.points},
          {"slabs", slice.sweep.slabs},
          {"event_points", slice.sweep.event_points},
          {"states", slice.sweep.states},
          {"resolved_layers", slice.sweep.resolved_layers},
          {"image_pixels", slice.paper.pixels()},
          {"image_samples", slice.paper.samples},
          {"image_bytes", slice.paper.image_bytes()},
          {"dense_image_bytes", slice.paper.dense_image_bytes()},
          {"vanished_regions", slice.losses.vanished_regions},
          {"vanished_holes", slice.losses.vanished_holes},
          {"broken_walls", slice.losses.broken_walls},
          {"closed_gaps", slice.losses.closed_gaps},
          {"open_paths", slice.open_paths},
          {"unbalanced_clusters", slice.sweep.unbalanced_clusters},
          {"repaired_clusters", slice.sweep.repaired_clusters},
          {"capped_clusters", slice.sweep.capped_clusters},
          {"snapped_layers", report.snapped_layers},
          {"warnings", report.warnings},
          {"deviation_mm", deviation_json(report.deviation)}};
}

// What only the paper's contours have.
Json paper_json(const slicer::SliceReport& slice, ldni::SamplerKind sampler) {
  const ldni::PaperCounts& paper = slice.paper;
  return {{"sampler", ldni::kSamplerNames[static_cast<std::size_t>(sampler)]},
          {"renderer", slice.renderer},
          {"boolean_seconds", number(paper.boolean_seconds)},
          {"link_seconds", number(paper.link_seconds)},
          {"image_intervals", paper.intervals},
          {"repaired_pixels", paper.repaired_pixels}};
}

Json place_json(Vec3 place) { return Json{place.x, place.y, place.z}; }

Json hollow_json(const slicer::HollowReport& hollow) {
  Json drains = Json::array();
  for (const slicer::Drain& drain : hollow.drains) {
    drains.push_back({{"from", place_json(drain.from)},
                      {"to", place_json(drain.to)},
                      {"diameter_mm", number(drain.diameter)}});
  }
  return {{"cavities", hollow.cavities},
          {"filled", hollow.filled},
          {"saved_mm3", number(hollow.saved_volume)},
          {"solid_mm3", number(hollow.solid_volume)},
          {"drains", std::move(drains)}};
}

Json sprues_json(const slicer::SpruePlan& plan) {
  Json sprues = Json::array();
  for (const slicer::Sprue& sprue : plan.sprues) {
    sprues.push_back({{"exit", place_json(sprue.exit)},
                      {"gate", place_json(sprue.gate)},
                      {"diameter_mm", number(sprue.diameter)},
                      {"feeds_mm3", number(sprue.feeds)},
                      {"at", sprue.at}});
  }
  Json unfed = Json::array();
  for (const slicer::Pool& pool : plan.unfed) {
    unfed.push_back({{"place", place_json(pool.place)},
                     {"thickness_mm", number(pool.thickness)},
                     {"volume_mm3", number(pool.volume)}});
  }
  return {{"root", place_json(plan.root)},
          {"root_diameter_mm", number(plan.root_diameter)},
          {"volume_mm3", number(plan.volume)},
          {"sprues", std::move(sprues)},
          {"unfed", std::move(unfed)}};
}

Json losses_json(const slicer::BleedLosses& losses) {
  Json json = {{"layers", losses.layers}};
  if (losses.layers > 0) {
    json["greatest_mm2"] = number(losses.area);
    json["at"] = {losses.place.x, losses.place.y, losses.place.z};
  }
  return json;
}

// What was applied, and what light that bleeds loses all the same.
Json compensation_json(const compiler::Report& report) {
  const slicer::Compensation& done = report.compensation;
  const bool has_foot = done.foot.inset != 0;
  Json json = {{"contour_mm", number(done.contour)},
               {"foot_mm", number(done.foot.inset)},
               {"foot_layers", has_foot ? done.foot.layers : 0},
               {"bleed_mm", number(done.bleed)}};
  if (report.bleed) {
    json["low_walls"] = losses_json(report.bleed->walls);
    json["low_gaps"] = losses_json(report.bleed->gaps);
  }
  return json;
}

// whole  what the whole program took; empty for one compilation among several
Json report_with(const compiler::Compilation& compilation, const Json& whole) {
  const compiler::Report& report = compilation.report;
  const slicer::Settings& settings = compilation.request.job;
  Json json = passes_json(report);
  json.update(whole);
  json.update(layers_json(report));
  if (settings.contour == slicer::ContourMode::kPaper) {
    json.update(paper_json(report.slice, settings.paper.sampler));
  }
  if (report.slice.print) {
    json["print"] = print_json(*report.slice.print, report.lines.findings);
  }
  json.update(machine_json(report.machine, report.estimate));
  if (const auto& direction = report.direction) {
    json["orient"] = {
        {"option", "--orient " + compiler::direction_text(direction->up)},
        {"judged", direction->judged}};
  }
  if (report.hollow) json["hollow"] = hollow_json(*report.hollow);
  if (report.sprues) json["sprues"] = sprues_json(*report.sprues);
  if (report.compensation.is_any()) {
    json["compensation"] = compensation_json(report);
  }
  if (const auto& measures = report.slice.supports) {
    json["supports"] = supports_json(*measures, report.lines.contacts);
  }
  if (const auto& plan = report.supports) {
    json["supports"].update({{"count", plan->supports.size()},
                             {"on_part", plan->count_on_part()},
                             {"unheld", plan->unheld.size()},
                             {"unwanted", plan->unwanted.size()},
                             {"tip_mm", plan->sizes.tip}});
  }
  if (settings.min_feature > 0) {
    json["min_feature_mm"] = number(settings.min_feature);
    json["features"] = features_json(report, settings.min_feature);
  }
  return json;
}

// earlier_seconds  of processor time, before this compilation
std::string report_text(const compiler::Compilation& compilation,
                        double earlier_seconds) {
  return json_text(report_with(
      compilation,
      {{"total_seconds", number(process_seconds() - earlier_seconds)},
       {"wall_seconds", number(compilation.report.wall_seconds)},
       {"peak_memory_bytes", peak_memory_bytes()}}));
}

// "print: 2 islands; for where, run:\n  lamina check ring.scad"
std::string print_line(const compiler::Report& report,
                       const std::function<std::string()>& check) {
  const auto& print = report.slice.print;
  if (!print) return {};
  const std::string counts = finding_counts(*print);
  const bool is_any = std::ranges::any_of(
      print->findings,
      [](const slicer::Finding& finding) { return !finding.is_minor; });
  return is_any ? fmt::format("\nprint: {}; for where, run:\n  {}", counts,
                              check())
                : fmt::format("\nprint: {}", counts);
}

std::string sprues_line(const compiler::Report& report) {
  return report.sprues ? "\nsprues: " + size_text(*report.sprues) : "";
}

std::string supports_line(const compiler::Report& report) {
  const auto& measures = report.slice.supports;
  return measures ? "\nsupports: " + size_text(*measures) : "";
}

// "hollow: 1 cavity, saves 312 mm³ (63 %) and 0.34 g; 2 drains of 1.2 mm"
std::string hollow_line(const compiler::Report& report) {
  if (!report.hollow || report.hollow->cavities == 0) return {};
  const slicer::HollowReport& hollow = *report.hollow;
  std::string line = fmt::format(
      "\nhollow: {}, saves {:.4g} mm³ ({:.0f} %)",
      counted(hollow.cavities, "cavity", "cavities"), hollow.saved_volume,
      100 * hollow.saved_volume / hollow.solid_volume);
  for (const auto& material : {report.machine.material, report.machine.metal}) {
    if (!material) continue;
    const double grams = material->weight(hollow.saved_volume);
    line += fmt::format(", {:.3g} g", grams);
    if (material->price) {
      line += slicer::price_text(
          *material, material->price->of(grams, hollow.saved_volume));
    }
  }
  if (!hollow.drains.empty()) {
    line +=
        fmt::format("; {} of {:g} mm", counted(hollow.drains.size(), "drain"),
                    hollow.drains.front().diameter);
  }
  if (hollow.filled > 0) {
    line += fmt::format("; {} without a drain stay{} solid",
                        counted(hollow.filled, "cavity", "cavities"),
                        hollow.filled == 1 ? "s" : "");
  }
  return line;
}

// "compensated: contours 0.03 mm, foot 0.1 mm over 4 layers, bleed 0.05 mm"
std::string compensation_line(const compiler::Report& report) {
  const slicer::Compensation& done = report.compensation;
  if (!done.is_any()) return {};
  std::string words;
  const auto add = [&words](const std::string& word) {
    words += (words.empty() ? "" : ", ") + word;
  };
  if (done.contour != 0) add(fmt::format("contours {:g} mm", done.contour));
  if (done.foot.inset != 0) {
    add(fmt::format("foot {:g} mm over {}", done.foot.inset,
                    counted(done.foot.layers, "layer")));
  }
  if (done.bleed != 0) add(fmt::format("bleed {:g} mm", done.bleed));
  return "\ncompensated: " + words;
}

// "\n" and the line of a search for a direction, if there was one.
std::string oriented_line(const compiler::Report& report) {
  return report.direction ? "\n" + direction_line(report) : "";
}

std::string machine_line(const compiler::Report& report) {
  const std::string text =
      slicer::estimate_text(report.machine, report.estimate);
  return text.empty() ? "" : "\n" + text;
}

// "ring.slc: 98 layers, 810 loops, …"
std::string summary_line(const compiler::Compilation& compilation,
                         const std::function<std::string()>& check,
                         double earlier_seconds) {
  const std::string& output = compilation.request.output.path;
  const compiler::Report& report = compilation.report;
  const slicer::SliceReport& slice = report.slice;
  return fmt::format(
      "{}: {}, {}, {}, {}{}{}{}{}{}{}{}{}{}\n"
      "{:.3f} s of processor time (load {:.3f}, evaluate {:.3f}, lower {:.3f}, "
      "sections {:.3f}, sweep {:.3f}, graph {:.3f}, output {:.3f}), {} of "
      "memory, {:.3f} s by the clock",
      output == "-" ? "standard output" : on_one_line(display_path(output)),
      counted(slice.layers, "layer"), counted(slice.loops, "loop"),
      counted(slice.points, "vertex", "vertices"),
      memory_text(report.output_bytes),
      slice.box.is_empty() ? "" : ", " + size_text(slice.box.size()),
      slice.volume > 0 ? fmt::format(", {:.6g} mm³", slice.volume) : "",
      machine_line(report), oriented_line(report), hollow_line(report),
      compensation_line(report), sprues_line(report), supports_line(report),
      print_line(report, check), process_seconds() - earlier_seconds,
      report.load_seconds, report.evaluate_seconds, report.lower_seconds,
      section_seconds(report), slice.sweep_seconds, slice.graph_seconds,
      slice.output_seconds, memory_text(peak_memory_bytes()),
      report.wall_seconds);
}

}  // namespace

double process_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec) + seconds_of_children();
}

std::uint64_t peak_memory_bytes() {
  if (const std::uint64_t bytes = peak_of_address_space()) return bytes;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string direction_line(const compiler::Report& report) {
  return fmt::format("direction: --orient {}, found among {}",
                     compiler::direction_text(report.direction->up),
                     counted(report.direction->judged, "direction"));
}

Json report_json(const compiler::Compilation& compilation) {
  return report_with(
      compilation, {{"wall_seconds", number(compilation.report.wall_seconds)}});
}

Json box_json(const Box3& box) {
  if (box.is_empty()) return nullptr;
  return {{"low", {box.low.x, box.low.y, box.low.z}},
          {"high", {box.high.x, box.high.y, box.high.z}}};
}

std::string size_text(Vec3 size) {
  if (size.x < 0) return "-";
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", size.x, size.y, size.z);
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json print_json(const slicer::PrintCheck& print,
                std::span<const compiler::SourceLines> lines) {
  Json findings = Json::array();
  for (std::size_t i = 0; i < print.findings.size(); ++i) {
    Json& finding = findings.emplace_back(finding_json(print.findings[i]));
    if (i < lines.size()) finding["made_by"] = lines_json(lines[i]);
  }
  return {{"peel", peel_json(print.peel)}, {"findings", std::move(findings)}};
}

Json supports_json(const slicer::SupportMeasures& supports,
                   std::span<const compiler::SourceLines> lines) {
  Json contacts = Json::array();
  for (std::size_t i = 0; i < supports.contacts.size(); ++i) {
    const slicer::SupportContact& contact = supports.contacts[i];
    Json& json =
        contacts.emplace_back(Json{{"layer", contact.layer},
                                   {"z", contact.section_z},
                                   {"x", contact.place.x},
                                   {"y", contact.place.y},
                                   {"area_mm2", contact.area},
                                   {"is_from_above", contact.is_from_above}});
    if (i < lines.size()) json["made_by"] = lines_json(lines[i]);
  }
  return {{"volume_mm3", supports.volume},
          {"contact_area_mm2", supports.contact_area()},
          {"contacts", std::move(contacts)}};
}

Json machine_json(const compiler::Machine& machine,
                  const slicer::PrintEstimate& estimate) {
  Json json = Json::object();
  const auto add = [&json](const std::string& prefix,
                           const std::optional<slicer::Material>& material,
                           double grams, double price) {
    if (!material) return;
    json[prefix + "grams"] = grams;
    if (price == 0) return;
    json[prefix + "price"] = price;
    json[prefix + "currency"] = material->price->currency;
  };
  if (machine.printer) json["printer"] = machine.printer->name;
  if (machine.material) json["material"] = machine.material->name;
  add("", machine.material, estimate.grams, estimate.price);
  if (machine.metal) json["metal"] = machine.metal->name;
  add("metal_", machine.metal, estimate.metal_grams, estimate.metal_price);
  if (estimate.seconds > 0) {
    json["print_seconds"] = estimate.seconds;
    json["exposure_s"] = estimate.exposure.exposure.layer;
    json["first_exposure_s"] = estimate.exposure.exposure.first;
    json["exposure_is_assumed"] = estimate.exposure.is_assumed;
  }
  return json;
}

std::string feature_lines(const compiler::Compilation& compilation) {
  const compiler::Report& report = compilation.report;
  std::string lines =
      feature_table(report.slice.features, compilation.request.job.min_feature,
                    compiler::texts_of(report.lines.features));
  lines.pop_back();
  return lines;
}

int compile_and_report(Session& session, const Closing& closing,
                       double earlier_seconds) {
  compiler::Compilation& compilation = session.compilation;
  const compiler::Request& request = compilation.request;
  // The report is opened first: no layers are written beside one that cannot be
  // made.
  std::unique_ptr<OutputFile> file;
  if (!closing.report.empty()) {
    file.reset(new OutputFile(
        OutputFile::open(closing.report, compilation.temporary_files)));
  }
  if (!compiler::compile(compilation)) return kFault;
  if (!request.output.is_of_layers()) return kDone;
  if (file != nullptr) {
    file->write(report_text(compilation, earlier_seconds));
    file->commit();
  }
  if (request.job.min_feature > 0) {
    session.terminal.say(feature_lines(compilation));
  }
  // The memory in it costs a small run a tenth of its time to find out.
  if (!session.terminal.is_quiet()) {
    session.terminal.say(
        summary_line(compilation, closing.check, earlier_seconds));
  }
  return kDone;
}

}  // namespace lamina::cli
