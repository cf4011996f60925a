#pragma once
// A design's way to its output: layers, or the text of a stage before.
//
//   load ─▶ parse ─▶ evaluate ─▶ lower ─▶ slice ─▶ write
//
// Nothing is computed here. Each pass appends to Diagnostics and throws where
// the run must end.

#include "compiler/run.h"

namespace lamina::cli {

// All passes that the format of the output asks for. Returns the exit status;
// throws what run_caught shows.
int compile(Run& run);

// What a run that ended well and made layers tells of itself: the file of
// --report, features, a closing line.
void show_report(Run& run);

}  // namespace lamina::cli
