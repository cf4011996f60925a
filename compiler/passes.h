#pragma once
// The passes one by one, as compile() calls them: each turns what the request
// says into the options of its stage.

#include <string>
#include <string_view>

#include "compiler/compilation.h"
#include "csg/lower/lower.h"
#include "ldni/section/grid.h"
#include "parser/ast.h"
#include "slicer/contour/layer.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {

// Reads and parses the design and the files that it names, decides in which
// language they are written, and sets the parameters of the design's set.
ast::Program load(Compilation& compilation);

// The CSG tree of the design. It is empty where the evaluation failed: by an
// assertion, endless recursion or, under hard warnings, a warning.
csg::Tree evaluate(Compilation& compilation, const ast::Program& program);

// What compilation.tree stands for, turned to the axis and placed on the bed.
csg::Lowered lower(Compilation& compilation);

// The settings of the request, with the limits of its format.
slicer::Settings settings_of(const Request& request);

// Where the layers stand; of an outline, nowhere. Throws GeometryError where
// the solid is empty or has too many layers.
ldni::LayerGrid plan(const csg::Lowered& lowered,
                     const slicer::Settings& settings);

// Sends all layers to `sink`. Several threads may slice one scene.
slicer::SliceReport slice(const csg::Lowered& lowered,
                          const ldni::LayerGrid& grid,
                          const slicer::Settings& settings,
                          slicer::LayerSink& sink, Diagnostics& diagnostics);

// Texts of stages before layers: all messages so far, as openscad's `.echo`
// holds them, and the tree as its `.csg` does.
std::string echo_text(Compilation& compilation);
std::string csg_text(Compilation& compilation);

// Writes a whole file.
void write_file(const std::string& path, std::string_view text,
                TemporaryFiles& temporary_files);

}  // namespace lamina::compiler
