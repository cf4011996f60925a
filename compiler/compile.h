#pragma once
// A design's way to its output: layers, or the text of a stage before.
//
//   load, parse ─▶ evaluate ─▶ lower ─▶ plan ─▶ slice ─▶ write
//
// Each pass appends to Diagnostics and throws where the compilation must end.
// The program, the library, tests and benchmarks call the same passes.

#include <optional>

#include "compiler/compilation.h"
#include "csg/lower/lower.h"
#include "slicer/contour/layer.h"

namespace lamina::compiler {

// All passes that the format of the output asks for, and the report. Returns
// false where a pass failed.
bool compile(Compilation& compilation);

// The pass from the text to the parsed design, for a compilation that is copied
// before it goes on: the passes below then go on from here. What changes the
// text of the design, supports above all, cannot be asked for any more.
void read_design(Compilation& compilation);

// The passes from the text to the tree. Returns false where one failed.
bool make_tree(Compilation& compilation);

// The pass from the tree to what can be sliced; drops the tree's nodes. Throws
// GeometryError where judge() does.
csg::Lowered lower_tree(Compilation& compilation);

// Both of these. No value where the tree could not be made.
std::optional<csg::Lowered> make_geometry(Compilation& compilation);

// Whether warnings, or errors, end a strict run here, without an output; says
// so.
bool ends_strictly(Compilation& compilation);

// Whether findings of --fail-on end the run, without an output; says so.
bool ends_on_findings(Compilation& compilation);

// Says that strict runs do not write what has warnings; returns whether there
// are some.
bool has_refused_warnings(Diagnostics& diagnostics);

// Plans and slices, with the request's settings or others; reports progress.
slicer::SliceReport make_layers(Compilation& compilation,
                                const csg::Lowered& lowered,
                                const slicer::Settings& settings,
                                slicer::LayerSink& sink);

}  // namespace lamina::compiler
