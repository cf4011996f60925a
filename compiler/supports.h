#pragma once
// Supports of a design: planned on its layers, and added to its text.

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/temporary_files.h"
#include "compiler/machine.h"
#include "compiler/request.h"
#include "csg/scene.h"
#include "slicer/supports/support_plan.h"

namespace lamina::compiler {

// The supports that the request asks for, made by slicing the design without
// them. No value where the design fails: the run itself will say why. Warns of
// what the design or the request says of supports and does not mean anything,
// and of places that need a support and have none.
//
// Throws GeometryError where the design has supports already, or would need too
// many.
std::optional<slicer::SupportPlan> plan_supports(const Request& request,
                                                 std::size_t evaluation_stack,
                                                 TemporaryFiles& files,
                                                 Diagnostics& diagnostics);

// A tip of 0 becomes that of the material, or the usual one.
slicer::SupportSizes support_sizes(const slicer::SupportSizes& asked,
                                   const Machine& machine);

// The leaves whose tips the design or the request decides, by their diameter:
// where none are wanted comes first.
//
// layers  of the scene; their heights
std::vector<slicer::MarkedSolid> marked_solids(
    const csg::Scene& scene, const std::vector<slicer::Layer>& layers,
    const Request& request);

// The lines of OpenSCAD that add them to the design's text.
std::string support_lines(const slicer::SupportPlan& plan,
                          const GeometryRequest& geometry);

}  // namespace lamina::compiler
