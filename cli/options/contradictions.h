#pragma once
// Options that each are good, but not together. They are refused with a
// UsageError, so that nobody takes for done what was not. Only options of
// slicing may stand idle: one set of them goes for layers and texts of a
// design.

#include <string>
#include <string_view>

#include "compiler/request.h"

namespace lamina::cli {

// Settings that contradict each other.
void refuse_contradictions(const slicer::Settings& settings);

// What the format of the output cannot give.
//
// has_report  --report is given
void refuse_misfits(const compiler::Request& request, bool has_report);

// A file that is named as layers that are written only, such as ring.sl1.
// `command` is what would have read it.
void require_readable(std::string_view command, const std::string& file);

}  // namespace lamina::cli
