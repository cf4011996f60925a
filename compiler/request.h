#pragma once
// What a compilation is asked for.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "csg/eval/evaluator.h"
#include "parser/customizer/parameter_set.h"
#include "slicer/casting/sprue_plan.h"
#include "slicer/dump/layer_dump.h"
#include "slicer/formats/output_format.h"
#include "slicer/hollow/hollow.h"
#include "slicer/machine/material.h"
#include "slicer/slice/settings.h"
#include "slicer/supports/support_plan.h"

namespace lamina::compiler {

// GeometryRequest::axis that lets the program choose.
inline constexpr std::string_view kAutomaticAxis = "auto";

// What is read, and how the design's program runs.
struct DesignRequest {
  // The path of a design, or of a file that import() reads.
  std::string path;
  // The design itself; `path` is only its name then.
  std::optional<std::string> text;
  std::string appended;  // lines that follow the text, before the definitions
  // The part to take of a FreeCAD file or a 3MF; empty: all that it shows.
  std::string part;
  std::string definitions;     // of all -D, as text: "a=1;\nb=2;\n"
  std::string parameter_file;  // -p; empty: none
  std::string parameter_set;   // -P
  // The set itself; no file is read for it then.
  std::optional<ParameterSet> parameters;
  // What values of that set are that the design does not get as they are.
  Misfit misfit = Misfit::kWarning;
  std::string language = "auto";  // or "2021", "2026"; see load()
  std::uint32_t seed = 0;
  std::uint32_t max_depth = csg::EvaluateOptions().max_depth;
  std::uint32_t max_leaves = csg::EvaluateOptions().max_leaves;
  bool checks_parameters = true;
  bool checks_parameter_ranges = false;
  bool has_hard_warnings = false;
  // openscad's modes of --render and --preview; empty: not given. Only
  // $preview shows which one it is.
  std::string render;
  std::string preview;
  // The first option that was given of those which only a design obeys, such
  // as "--scale"; empty: none. A file of layers in its place is refused then.
  std::string given_option;
  // A folder where modules (lamina_text.so) are looked for first; empty: none.
  std::string module_folder;
};

// How the design's solid becomes the one that is sliced.
struct GeometryRequest {
  std::string axis = "z";  // of slicer::kAxes, or kAutomaticAxis
  // A direction of the design that points up, instead of an axis.
  std::optional<Vec3> up;
  // That direction is the N-th of those that a search lists, from 1; 0: none is
  // searched for.
  unsigned searched_direction = 0;
  double turn = 0;  // about the axis, anticlockwise from above [degrees]
  bool is_placed_on_bed = false;
  Vec3 scale = Vec3(1);      // along x, y and z of the print
  double chordal_error = 0;  // [mm]; 0: $fa and $fs decide
  double decimation = 0;     // of imported meshes [mm]; 0: none
};

// What is asked of the compensation; what is not given is the material's, or 0.
struct CompensationRequest {
  std::optional<double> contour;  // as of slicer::Compensation
  std::optional<slicer::Foot> foot;
  std::optional<double> bleed;

  // Leaves out what depends on how a part stands on the bed, for passes that
  // look at it before it stands there.
  void drop_bed() {
    foot.emplace();
    bleed = 0;
  }
};

// Lines of the design, "12" or "lib.scad:12", that decide where supports are.
struct SupportLines {
  std::vector<std::string> only;     // not empty: below these alone
  std::vector<std::string> without;  // not below these
};

// What is written.
struct OutputRequest {
  std::string path;  // "-": standard output
  // A stage of one layer is written instead of layers, and a height in that
  // layer [mm]: as a drawing where the path ends with .svg, else as text.
  std::optional<slicer::DumpStage> dump;
  std::optional<double> dump_height;
  slicer::OutputFormat format = slicer::OutputFormat::kSlc;
  std::optional<slicer::CliEncoding> cli_encoding;
  std::string printer;   // name or profile; empty: of images the format's
  std::string material;  // name or profile; empty: none
  std::string metal;     // that is cast from it, likewise
  std::vector<slicer::Price> prices;  // of these two
  bool mirrors_x = false;             // the image
  bool mirrors_y = false;
  std::string dependencies;  // path of the rule for make (-d); empty: none
  // A warning or an error ends the run with no output, when its stage is done.
  // Not given: where the files that may be read are confined.
  std::optional<bool> is_strict;

  bool is_of_layers() const { return !dump && slicer::is_of_layers(format); }
};

// From a design to layers, or to one of the stages on the way.
struct Request {
  DesignRequest design;
  GeometryRequest geometry;
  // Lengths as the print has them, places as the design has them.
  std::optional<slicer::HollowSizes> hollow;
  slicer::Settings job;  // how the solid is sliced, but for compensation
  CompensationRequest compensation;
  // Sprues are added to the design.
  std::optional<slicer::SprueSizes> sprues;
  // Supports are added to the design and to its sprues. A tip of 0 is that of
  // the material, or the usual one.
  std::optional<slicer::SupportSizes> supports;
  SupportLines support_lines;
  std::string raft_label;  // a text in the raft of the supports; empty: none
  OutputRequest output;
};

// The same design as it is drawn: neither turned nor moved, scaled, hollowed,
// supported or compensated.
Request as_drawn(Request request);

// Meshes and drawings can stand in the place of a design: `lamina ring.stl`
// slices what `import("ring.stl");` makes. By its name: what import() reads and
// is not a design and no file of layers, in any letter case. (A .3mf may hold
// either; import() takes its mesh.)
bool is_imported(const std::string& path);

// Whether the path has the name of a design in OpenSCAD's language, in any
// letter case.
bool is_design(const std::string& path);

// Whether parts of the file have names or numbers that lamina reads: a file of
// a CAD program or a 3MF. By its name.
bool has_parts(const std::string& path);

// The text of a design in a folder that is this one, with its definitions: it
// includes it, or imports it.
std::string design_that_takes(const DesignRequest& design,
                              const std::string& folder);

// The text of a design that imports the file beside it, or a part of it.
std::string import_of(const std::string& path, const std::string& part = {});

}  // namespace lamina::compiler
