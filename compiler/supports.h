#pragma once
// Supports of a design: planned on its layers, and added to its text.

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/file/temporary_files.h"
#include "compiler/request.h"
#include "slicer/supports/support_plan.h"

namespace lamina::compiler {

// The supports that the request asks for, made by slicing the design without
// them. No value where the design fails: the run itself will say why.
std::optional<slicer::SupportPlan> plan_supports(const Request& request,
                                                 std::size_t evaluation_stack,
                                                 TemporaryFiles& files);

// The lines of OpenSCAD that add them to the design's text.
std::string support_lines(const slicer::SupportPlan& plan,
                          const GeometryRequest& geometry);

// Warns of places to which no support leads.
void warn_of_unheld(const slicer::SupportPlan& plan, Diagnostics& diagnostics);

}  // namespace lamina::compiler
