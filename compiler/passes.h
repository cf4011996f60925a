#pragma once
// The passes one by one. Each turns its part of a request into the options of
// its stage, appends to Diagnostics, and throws where the run must end.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "compiler/machine.h"
#include "compiler/request.h"
#include "csg/cad/cad_reader.h"
#include "csg/lower/lower.h"
#include "csg/text/typesetter.h"
#include "csg/tree.h"
#include "ldni/section/grid.h"
#include "parser/ast.h"
#include "parser/loader.h"
#include "slicer/bleed/bleed.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {

// Called with the number of layers done and of all that there can be: with 0
// before the first layer, after each, and with both equal after the last. By
// one thread at a time.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

// A design as its text says it.
struct LoadedDesign {
  ast::Program program;
  Language language = Language::k2021;  // as asked for, or as found
  // Whether the parameter set was applied. Where not, that is reported.
  bool has_parameters = true;
};

// Reads and parses the design and the files that it names, and decides in which
// language they are written.
LoadedDesign read(const DesignRequest& request, Loader& loader,
                  Diagnostics& diagnostics);

// Gives the parameters of the design the values of the request's set.
void set_parameters(const DesignRequest& request, const FileAccess& access,
                    LoadedDesign& design, Diagnostics& diagnostics);

// How the design is turned before it is sliced; the same for --axis auto, which
// turns the solid itself.
Affine turn_of(const GeometryRequest& request);

// What reads fonts and CAD files for the passes of one run.
struct Readers {
  Readers(const DesignRequest& request, const FileAccess& access,
          Diagnostics& diagnostics);

  const FileAccess& file_access;
  std::vector<std::string> module_folders;  // base/file/module.h
  text::Typesetter typesetter;
  cad::Reader cad_reader;
};

// The CSG tree of the design. It has no root where the evaluation failed: by an
// assertion, endless recursion or, under hard warnings, a warning.
//
// design       gets its language where what runs decides it
// stack_bytes  that evaluation may use below the caller's frame
csg::Tree evaluate(LoadedDesign& design, const Request& request,
                   const Loader& loader, Readers& readers,
                   std::size_t stack_bytes, Diagnostics& diagnostics);

// What the tree means, turned to the axis: a scene, an outline, or nothing.
//
// machine  for whose printer --axis auto chooses
csg::Lowered lower(const csg::Tree& tree, const Request& request,
                   const Machine& machine, Readers& readers,
                   Diagnostics& diagnostics);

// Hollows a solid, if that is asked for.
std::optional<slicer::HollowReport> hollow(csg::Lowered& lowered,
                                           const Request& request,
                                           const Machine& machine,
                                           Diagnostics& diagnostics);

// Shifts a solid onto the bed, if that is asked for.
void place_on_bed(csg::Lowered& lowered, const GeometryRequest& request);

// How the print is compensated: as asked for, and else as the material's
// profile says.
slicer::Compensation compensation_of(const Request& request,
                                     const Machine& machine);

// Moves faces of a solid that look down, if that is asked for. It must stand
// where it will be printed.
//
// compensation  of an outline loses what needs a solid, with a warning
std::optional<slicer::BleedReport> mend_bleed(
    csg::Lowered& lowered, const slicer::Settings& settings,
    slicer::Compensation& compensation, Diagnostics& diagnostics);

// Throws GeometryError where that is nothing, or an outline that the format of
// the output cannot hold; warns of what is probably not meant.
void judge(const csg::Lowered& lowered, const Request& request,
           Diagnostics& diagnostics);

// The settings of the request, with its compensation and the limits of its
// format and of the printer: what is smaller than its pixel is too small to
// matter. Supports hold what is near.
slicer::Settings settings_of(const Request& request, const Machine& machine);

// Where the layers are; of an outline there is none. Throws GeometryError where
// the solid is empty or has too many layers.
ldni::LayerGrid plan(const csg::Lowered& lowered,
                     const slicer::Settings& settings);

// Sends all layers to `sink`. Several threads may slice one scene.
slicer::SliceReport slice(const csg::Lowered& lowered,
                          const ldni::LayerGrid& grid,
                          const slicer::Settings& settings,
                          slicer::LayerSink& sink, const Progress& progress,
                          Diagnostics& diagnostics);

}  // namespace lamina::compiler
