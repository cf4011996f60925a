#pragma once
// What layers hold: those of a file of layers, or those that a design makes.
// `check`, `inspect`, `view`, `compare` and the C++ interface ask here.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"
#include "compiler/compilation.h"
#include "ldni/section/grid.h"
#include "slicer/check/defects/inspect.h"
#include "slicer/thickness/thin_places.h"

namespace lamina::compiler {

// Whether the path names a file of layers, not a design or a mesh.
bool holds_layers(const std::string& path, const FileAccess& access);

// Throws RequestError where an option of designs was given: the file at `path`
// holds layers.
void refuse_design_options(const DesignRequest& request,
                           const std::string& path);

// Throws RequestError for the name of a file of layers that can only be
// written, such as ring.param.
//
// command  that would have read it
void require_readable(std::string_view command, const std::string& path);

struct LookOptions {
  // Whether loops are searched for defects, and meshes of a file that is
  // imported are measured.
  bool finds_defects = false;
  // Walls and gaps thinner than this are searched for in the layers as they are
  // written [mm]; 0: none are.
  double min_feature = 0;
  // Whether a design is searched for what is thinner than the request's
  // min_feature in space, and in no layer: tens of times the cost. Parts that
  // are more than some thousand times as large are not.
  bool finds_hidden = false;
  // Whether the layer graph is made of a file; of a design the slicer makes it.
  bool makes_graph = true;
  bool keeps_layers = false;
  bool keeps_colors = false;  // with these layers: of a design's color()
};

// A wall, wire or gap that lies flat or leans, so that its layers are wide.
struct HiddenThin {
  slicer::ThinPlace place;
  SourceLines lines;
};

struct Inspection {
  // If the request asks the slicer for thin features, they are those.
  slicer::Inspection found;
  FoundLines lines;  // of a design
  std::vector<slicer::Layer> layers;
  // The thinnest first; no value where they were not searched for.
  std::optional<std::vector<HiddenThin>> hidden;
};

// Looks at the request's file or design. No value where the design failed,
// which is reported. Throws FileError where a file of layers cannot be read,
// RequestError where options of designs were given for it.
std::optional<Inspection> look_at(Compilation& compilation,
                                  const LookOptions& options);

// Looks at a file of layers alone.
Inspection look_at_file(const std::string& path, const LookOptions& options,
                        const slicer::PrintRules& rules,
                        const FileAccess& access);

// Looks at a design that has been made for a machine.
//
// grid  of plan(), by the settings of the request and the machine
Inspection look_at_design(const csg::Lowered& lowered,
                          const ldni::LayerGrid& grid, const Request& request,
                          const Machine& machine, const LookOptions& options,
                          const Progress& progress, Diagnostics& diagnostics);

}  // namespace lamina::compiler
