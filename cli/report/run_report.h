#pragma once
// What a compilation cost: the closing line on the terminal and `--report`.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "base/vec.h"
#include "cli/report/session.h"

namespace lamina::cli {

// Processor seconds of all threads and child processes since the program began.
double process_seconds();

// The most memory that this program has held so far.
std::uint64_t peak_memory_bytes();

// The report of one compilation among several, without what only the whole
// program has, its total time and memory.
nlohmann::ordered_json report_json(const compiler::Compilation& compilation);

// Null for an empty box.
nlohmann::ordered_json box_json(const Box3& box);

// "20.6 x 7.52 x 24 mm"; "-" for that of an empty box.
std::string size_text(Vec3 size);

// One member a line, ended by '\n'. Bytes that are no UTF-8 are replaced: names
// of files and messages can hold any.
std::string json_text(const nlohmann::ordered_json& json);

// What the layer graph found, and the peel.
//
// lines  of the design, of each finding; none of a file
nlohmann::ordered_json print_json(const slicer::PrintCheck& print,
                                  std::span<const compiler::SourceLines> lines);

// What the supports are, and where they touch the part.
//
// lines  of the design, of each contact
nlohmann::ordered_json supports_json(
    const slicer::SupportMeasures& supports,
    std::span<const compiler::SourceLines> lines);

// The printer and the material, and what the print takes.
nlohmann::ordered_json machine_json(const compiler::Machine& machine,
                                    const slicer::PrintEstimate& estimate);

// The table of thin features that were found, without the last '\n'.
std::string feature_lines(const compiler::Compilation& compilation);

// "direction: --orient 0,0.6,0.8, found among 300 directions". The report has a
// direction.
std::string direction_line(const compiler::Report& report);

// What a run says at its end.
struct Closing {
  std::string report;  // path of --report; empty: none
  // Returns the words that look at the same print: "lamina check ring.scad -D
  // n=2". To find them takes longer than some designs.
  std::function<std::string()> check;
};

// compile(), and then what a compilation that made layers says of itself: the
// file of --report, thin features, a closing line. Returns the exit status.
//
// earlier_seconds  of processor time, before this compilation
int compile_and_report(Session& session, const Closing& closing,
                       double earlier_seconds = 0);

}  // namespace lamina::cli
