#pragma once
// Options that are each good, but not together. They are refused with a
// UsageError, so that nobody believes that an option was obeyed which was not.
// Only options of slicing may have no effect: the same set of them may be given
// for layers and for texts of a design. (That a design is an outline, which has
// no use for some of them, shows later: compile() warns.)

#include <string>
#include <string_view>

#include "compiler/request.h"

namespace lamina::cli {

// Refuses settings that contradict each other.
void refuse_contradictions(const slicer::Settings& settings);

// Refuses what the format of the output cannot give.
//
// has_report  --report is given
void refuse_misfits(const compiler::Request& request, bool has_report);

// Refuses a file that has the name of layers which can only be written, such as
// ring.sl1.
//
// command  that would have read it
void require_readable(std::string_view command, const std::string& file);

// Refuses options of designs for a file of layers.
//
// option  the first that was given (note_design_option()); empty: none
void refuse_design_option(const std::string& option, const std::string& file);

}  // namespace lamina::cli
