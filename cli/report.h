#pragma once
// What a run cost: the closing line on the terminal and `--report`.

#include <cstdint>
#include <string>

#include "slicer/slice.h"

namespace lamina::cli {

// Processor seconds of all threads since the program began.
double process_seconds();

// Greatest memory that the process held so far.
std::uint64_t peak_memory_bytes();

// Processor seconds, by pass.
struct RunReport {
  double load_seconds = 0;
  double evaluate_seconds = 0;
  double lower_seconds = 0;
  slicer::SliceReport slice;
  double wall_seconds = 0;  // of the whole run
};

// The whole as JSON, one key a line, ended by '\n'. Total and memory are those
// of the moment of the call.
std::string report_json(const RunReport& report);

// "ring.slc: 98 layers, 810 loops, …"
std::string summary_line(const std::string& output, std::uint64_t bytes,
                         const RunReport& report);

}  // namespace lamina::cli
