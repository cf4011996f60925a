#pragma once
// What a compilation is asked for.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "csg/eval/evaluator.h"
#include "parser/customizer/parameter_set.h"
#include "slicer/formats/output_format.h"
#include "slicer/slice/settings.h"

namespace lamina::compiler {

// Of Request::axis: the program chooses.
inline constexpr std::string_view kAutomaticAxis = "auto";

// From a design to layers, or to one of the stages on the way.
struct Request {
  // The path of a design or of a file that import() reads.
  std::string design;
  // The design itself; `design` is only its name then.
  std::optional<std::string> text;
  std::string output;  // path; "-": standard output
  slicer::OutputFormat format = slicer::OutputFormat::kSlc;
  std::optional<slicer::CliEncoding> cli_encoding;
  std::string printer;     // name or profile; empty: of images the format's
  std::string material;    // name or profile; empty: none
  bool mirrors_x = false;  // the image
  bool mirrors_y = false;
  std::string definitions;     // of all -D, as text: "a=1;\nb=2;\n"
  std::string parameter_file;  // -p; empty: none
  std::string parameter_set;   // -P
  // The set itself; no file is read for it then.
  std::optional<ParameterSet> parameters;
  std::string language = "auto";  // or "2021", "2026"; see load()
  std::string axis = "z";         // of slicer::kAxes, or kAutomaticAxis
  bool is_placed_on_bed = false;
  double scale = 1;
  double chordal_error = 0;  // [mm]; 0: $fa and $fs decide
  double decimation = 0;     // of imported meshes [mm]; 0: none
  slicer::Settings settings;
  std::uint32_t seed = 0;
  bool checks_parameters = true;
  bool checks_parameter_ranges = false;
  std::uint32_t max_depth = csg::EvaluateOptions().max_depth;
  std::uint32_t max_leaves = csg::EvaluateOptions().max_leaves;
  // openscad's modes of --render and --preview; empty: not given. Which one it
  // is shows in nothing but $preview.
  std::string render;
  std::string preview;
  std::string dependencies;  // path of the rule for make (-d); empty: none
  bool has_hard_warnings = false;
  // A warning or an error ends the run with no output, when its stage is done.
  // Not given: where the files that may be read are confined.
  std::optional<bool> is_strict;
  // A folder where modules (lamina_text.so) are looked for first; empty: none.
  std::string module_folder;
};

// Meshes and drawings can stand in the place of a design: `lamina ring.stl`
// slices what `import("ring.stl");` makes. By its name: what import() reads and
// is no design and no file of layers, in any letter case. (A .3mf may hold
// either; import() takes its mesh.)
bool is_imported(const std::string& path);

// The text of a design that imports the file beside it.
std::string import_of(const std::string& path);

}  // namespace lamina::compiler
