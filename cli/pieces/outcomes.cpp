#include "cli/pieces/outcomes.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/file/csv.h"
#include "base/text.h"
#include "cli/report/finding_table.h"
#include "cli/report/run_report.h"
#include "compiler/orient.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::ordered_json;
using Status = Outcome::Status;

// "2 warnings; 1 island": what a row says at its end.
std::string notes_of(const compiler::Report& report) {
  std::string text;
  if (report.warnings > 0) text = counted(report.warnings, "warning");
  if (report.slice.print && !report.slice.print->findings.empty()) {
    text += (text.empty() ? "" : "; ") + finding_counts(*report.slice.print);
  }
  if (const auto& supports = report.slice.supports) {
    text += fmt::format("{}{:.4g} mm³ of supports, {}",
                        text.empty() ? "" : "; ", supports->volume,
                        counted(supports->contacts.size(), "contact"));
  }
  if (report.direction) {
    text += fmt::format("{}--orient {}", text.empty() ? "" : "; ",
                        compiler::direction_text(report.direction->up));
  }
  return text;
}

std::string row_of(const Outcome& outcome) {
  // Its message has come before.
  if (!outcome.is_done()) return "failed";
  const compiler::Report& report = outcome.report;
  const std::string row = fmt::format(
      "{:>7}  {:>24}  {:>11.3f}  {:>9}  {:>7.3f}  {}", report.slice.layers,
      size_text(report.slice.box.size()), report.slice.volume,
      report.estimate.weight() > 0
          ? fmt::format("{:.3f}", report.estimate.weight())
          : "-",
      report.wall_seconds, notes_of(report));
  return row.substr(0, row.find_last_not_of(' ') + 1);
}

// New columns come last: scripts count them.
constexpr std::string_view kCsvHeader =
    "line,name,output,layers,x_mm,y_mm,z_mm,volume_mm3,grams,price,"
    "metal_grams,metal_price,print_seconds,seconds,warnings,findings,error,"
    "supports_mm3,contacts,contact_mm2,orient,contour_mm,foot_mm,foot_layers,"
    "bleed_mm\r\n";

// Empty where it is not known.
std::string figure(double value) {
  return value > 0 ? fmt::format("{}", value) : "";
}

// Where it was searched for: what repeats it without a search.
std::string direction_of(const Outcome& outcome) {
  const auto& direction = outcome.report.direction;
  return outcome.is_done() && direction
             ? fmt::format("\"{}\"", compiler::direction_text(direction->up))
             : "";
}

// Volume, contacts, and their area.
std::string supports_of(const Outcome& outcome) {
  const auto& supports = outcome.report.slice.supports;
  return outcome.is_done() && supports
             ? fmt::format("{},{},{}", supports->volume,
                           supports->contacts.size(), supports->contact_area())
             : ",,";
}

// What was applied: of contours, the foot and its layers, of bleeding light.
std::string compensation_of(const Outcome& outcome) {
  if (!outcome.is_done()) return ",,,";
  const slicer::Compensation& done = outcome.report.compensation;
  const bool has_foot = done.foot.inset != 0;
  return fmt::format("{},{},{},{}", done.contour, done.foot.inset,
                     has_foot ? done.foot.layers : 0, done.bleed);
}

std::string csv_of(const Piece& piece, const Outcome& outcome) {
  const std::string line = piece.line > 0 ? fmt::format("{}", piece.line) : "";
  std::string figures = ",,,,,,,,,,,,";
  if (outcome.is_done()) {
    const compiler::Report& report = outcome.report;
    const slicer::PrintEstimate& estimate = report.estimate;
    const Vec3 size = report.slice.box.size();
    figures = fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{}", report.slice.layers,
        report.slice.box.is_empty()
            ? ",,"
            : fmt::format("{:.6g},{:.6g},{:.6g}", size.x, size.y, size.z),
        report.slice.volume, figure(estimate.grams), figure(estimate.price),
        figure(estimate.metal_grams), figure(estimate.metal_price),
        figure(estimate.seconds), report.wall_seconds, report.warnings,
        csv_words(report.slice.print ? finding_counts(*report.slice.print)
                                     : ""));
  }
  return fmt::format("{},{},{},{},{},{},{},{}\r\n", line, csv_words(piece.name),
                     csv_words(piece.request.output.path), figures,
                     csv_words(outcome.error), supports_of(outcome),
                     direction_of(outcome), compensation_of(outcome));
}

std::string json_of(const Piece& piece, const Outcome& outcome) {
  return list_element(
      {{"line", piece.line > 0 ? Json(piece.line) : Json()},
       {"name", piece.name},
       {"output", piece.request.output.path},
       {"error", outcome.is_done() ? Json() : Json(outcome.error)},
       {"report", outcome.json}});
}

}  // namespace

Outcomes::Outcomes(const PiecesOptions& options, std::uint64_t count,
                   TemporaryFiles& temporary_files)
    : options_(options), count_(count) {
  const std::string& path = options.report;
  if (path.empty()) return;
  if (path.ends_with(".csv")) {
    csv_.reset(new OutputFile(OutputFile::open(path, temporary_files)));
    csv_->write(kCsvHeader);
  } else {
    json_ = std::make_unique<JsonList>(path, temporary_files);
  }
}

Outcomes::Entry Outcomes::describe(const Piece& piece,
                                   const Outcome& outcome) const {
  Entry entry;
  entry.status = outcome.status;
  if (outcome.status == Status::kStood) return entry;
  if (outcome.is_done()) {
    entry.machine = outcome.report.machine;
    entry.estimate = outcome.report.estimate;
  }
  if (count_ <= kMostRows) {
    entry.name = short_name(piece.name);
    entry.row = row_of(outcome);
  }
  if (csv_) entry.report = csv_of(piece, outcome);
  if (json_) entry.report = json_of(piece, outcome);
  return entry;
}

void Outcomes::add(const Entry& entry) {
  ++(entry.status == Status::kDone     ? done_
     : entry.status == Status::kFailed ? failed_
                                       : stood_);
  if (entry.status == Status::kStood) return;
  if (entry.status == Status::kDone) {
    machine_ = entry.machine;
    total_ = total_ + entry.estimate;
  }
  if (!entry.row.empty()) rows_.emplace_back(entry.name, entry.row);
  if (csv_) csv_->write(entry.report);
  if (json_) json_->add(entry.report);
}

std::string Outcomes::table(double seconds) const {
  std::size_t width = options_.unit.size();
  for (const auto& [name, row] : rows_) width = std::max(width, name.size());
  std::string table;
  if (count_ <= kMostRows) {
    table = fmt::format("{:<{}}  {:>7}  {:>24}  {:>11}  {:>9}  {:>7}\n",
                        options_.unit, width, "layers", "size", "volume mm³",
                        "weight g", "time s");
  }
  for (const auto& [name, row] : rows_) {
    table += fmt::format("{:<{}}  {}\n", name, width, row);
  }
  const std::string stood =
      stood_ > 0 ? fmt::format(" ({} of them before)", stood_) : "";
  const std::string total = slicer::estimate_text(machine_, total_);
  if (!total.empty()) {
    table +=
        fmt::format("in all{}: {}\n", stood_ > 0 ? " of this run" : "", total);
  }
  return table + fmt::format("{} of {} {} done{}, {} failed, in {:.3f} s",
                             done_ + stood_, count_, options_.unit, stood,
                             failed_, seconds);
}

void Outcomes::commit_report(double seconds) {
  if (csv_) csv_->commit();
  if (!json_) return;
  Json members = {{"done", done_},
                  {"failed", failed_},
                  {"total_seconds", process_seconds()},
                  {"wall_seconds", seconds},
                  {"peak_memory_bytes", peak_memory_bytes()},
                  {"volume_mm3", total_.volume}};
  members.update(machine_json(machine_, total_));
  if (stood_ > 0) members["done_before"] = stood_;
  json_->commit(std::move(members), "pieces");
}

}  // namespace lamina::cli
