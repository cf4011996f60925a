#pragma once
// lamina as a library: from an OpenSCAD design to its layers, in memory or in a
// file.
//
//   const auto ring = lamina::Design::from_file("ring.scad");
//   for (const lamina::Layer& layer : ring.slice()) use(layer.loops);
//
// This header is all that is installed. It shows no type of the stages behind
// it (docs/design.md), so that they may change without their users, and asks
// nothing of a compiler but C++20. Until version 1.0 it may change with the
// second number of the version.
//
// A fault of the design, of a file or of options is thrown as DesignError. What
// the program lamina refuses is refused here, too, in the names of this header.

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lamina {

// A place in a text, and what is said of it.
struct Remark {
  std::string message;  // "called from module 'prong'"
  std::string file;     // empty: no place is known
  unsigned line = 0;    // from 1
  unsigned column = 0;  // from 1, in bytes
};

// Its text is what the program prints: a message with its place, its line and
// carets below it, for each error.
class DesignError : public std::runtime_error {
 public:
  DesignError(const std::string& text, Remark first,
              std::vector<Remark> its_calls = {})
      : std::runtime_error(text),
        fault(std::move(first)),
        calls(std::move(its_calls)) {}

  Remark fault;               // the first error
  std::vector<Remark> calls;  // that led to it, the innermost first
};

struct Point {
  double x = 0;  // [mm]
  double y = 0;
};

// A closed polyline; the first point is not repeated at the end. Outer loops
// run counter-clockwise, holes clockwise.
using Loop = std::vector<Point>;

struct Layer {
  double section_z = 0;     // height of the section that the loops are of [mm]
  double bottom = 0;        // the layer's lower side [mm]
  double top = 0;           // its upper side; = bottom for sections at heights
  std::vector<Loop> loops;  // simple, disjoint, in no order
};

// [mm²]: positive for an outer loop, negative for a hole.
double signed_area(const Loop& loop);
// [mm²] of what is solid.
double area(const Layer& layer);

// A value of the design that its customizer lets users choose.
struct Parameter {
  std::string name;
  std::string value;    // in OpenSCAD's notation: `0.5`, `"round"`, `[1, 2]`
  std::string choices;  // likewise: `[0.25 : 0.25 : 3]`; empty: any value
  std::string description;  // empty: none
  std::string group;        // empty: none
};

// Values of parameters, by name, in the notation of Parameter, but texts
// without quotes.
using ParameterValues = std::vector<std::pair<std::string, std::string>>;

// A support that was added.
struct Support {
  Point contact;            // the middle of its tip
  double z = 0;             // likewise [mm]
  double tip = 0;           // its diameter there [mm]
  bool is_on_bed = true;    // false: it stands on the part or another support
  std::string source_line;  // of what it holds, as in ThinPlace
};

// A wall or gap that is too thin, in one layer or through several.
struct ThinPlace {
  bool is_wall = true;  // false: a gap
  double width = 0;     // where it is thinnest [mm]; 0: two sides meet there
  Point place;          // there
  double z = 0;         // likewise: the height of the section [mm]
  double bottom = 0;    // of its lowest layer [mm]
  double top = 0;       // of its highest layer [mm]
  // The lines of the design that made it: "ring.scad:12:3", or with the call
  // that led there, "lib.scad:8:5 from ring.scad:40:3"; joined by ", ".
  std::string source_line;
};

// What would go wrong in the print.
struct Finding {
  enum class Kind {
    kIsland,      // begins in mid-air: nothing in the layer below holds it
    kLoosePart,   // hangs together with nothing that reaches the bed
    kOverhang,    // reaches too far beyond the layer below
    kSuctionCup,  // a hollow that nothing leads out of while it is built
    kResinTrap    // a hollow that nothing leads out of at all
  };
  Kind kind = Kind::kIsland;
  bool is_minor = false;     // too small to matter
  unsigned first_layer = 0;  // from 1
  unsigned last_layer = 0;
  double bottom = 0;    // of its lowest layer [mm]
  double top = 0;       // of its highest layer [mm]
  Point place;          // a place inside it
  double z = 0;         // of that place: the height of the section [mm]
  double area = 0;      // the greatest of a layer [mm²]
  double volume = 0;    // of loose parts, cups and traps [mm³]
  double distance = 0;  // of an overhang, to what holds it [mm]
  // The line of the design that made it, as in ThinPlace; empty: not known.
  std::string source_line;
};

// What layers hold, and what is wrong with them.
struct Inspection {
  struct Row {
    double bottom = 0;     // of the layer [mm]
    double thickness = 0;  // [mm]
    std::size_t loops = 0;
    std::size_t holes = 0;  // of the loops
    std::size_t vertices = 0;
    double area = 0;       // of what is solid [mm²]
    double perimeter = 0;  // [mm]
  };
  std::string format;  // "SLC 2.0"; empty: layers of a design
  std::string writer;  // the program that made the file; empty: not known
  std::vector<Row> layers;
  double volume = 0;  // [mm³]
  // Loops that cross, repeat or are not closed, and layers that do not lie on
  // each other: their number, and the first ones in words.
  std::size_t defects = 0;
  std::vector<std::string> reported_defects;
  std::vector<ThinPlace> thin_places;
  std::vector<Finding> findings;
};

// What is looked for in layers.
struct InspectOptions {
  // How far a layer may reach beyond the one below [mm]; 0: as far as a surface
  // of 45° does.
  double self_supporting = 0;
  double min_feature = 0;  // thin places are narrower [mm]; 0: none are sought
};

// How a design is read. Names and defaults are those of the program's options
// (docs/usage.md).
struct DesignOptions {
  std::vector<std::string> definitions;  // of -D: "size=57"
  std::string parameter_file;            // of -p; empty: none
  std::string parameter_set;             // of -P, in that file
  // Instead of a parameter set. A value that the customizer does not offer is
  // an error.
  ParameterValues values;
  double chordal_error = 0;  // [mm]; 0: $fa and $fs decide
  double scale = 1;
  std::string axis = "z";  // direction of building: z, x, y, -x, -y, -z, auto
  bool place_on_bed = false;  // the lowest point goes to height 0
  // Supports are added: light, medium, heavy, the diameter of their tips in mm,
  // or auto: that of the material. Empty: none.
  std::string supports;
  bool has_raft = false;   // joins their feet
  bool has_sprue = false;  // sprues are added
  double hollow = 0;       // thickness of walls [mm]; 0: solid
  // That supports, drains and sprues are made for [mm].
  double layer_thickness = 0.05;
  // Names of `lamina printers` and `lamina materials`, or profiles; empty:
  // none.
  std::string printer;
  std::string material;
  std::string metal;
  std::vector<std::string> prices;  // of these two: "62.5/g", "60 EUR/l"
  // What OpenSCAD the design is written for: "2021", "2026", or "auto": 2026 if
  // 2021.01 cannot parse it.
  std::string language = "auto";
  unsigned seed = 0;  // of rands() where the design gives none
  // Limits: nested calls, and parts of the design. More is an error.
  unsigned max_depth = 300000;
  unsigned max_leaves = 10000000;
  // Of the caller's stack, that evaluation may take [bytes]. More is an error.
  std::size_t stack = std::size_t{6} << 20;
  // For designs that strangers write. With a root, files are read and written
  // in this folder only, links resolved; in `readable` they are read, too.
  std::string root;  // empty: everywhere
  std::vector<std::string> readable;
  bool no_import = false;  // refuse import(), surface() and the like
  // Gets what the design echoes and what it is warned of, as the program
  // prints it, at once.
  std::function<void(std::string_view message)> show;
  // Holds the modules: lamina_text.so, which text() needs, lamina_decimate.so,
  // which import(decimate =) needs, and lamina_cad.so, which STEP, IGES and
  // BREP need. The CMake target lamina::lamina defines where they lie.
#ifdef LAMINA_MODULE_FOLDER
  std::string module_folder = LAMINA_MODULE_FOLDER;
#else
  std::string module_folder;
#endif
};

// How it is sliced.
struct SliceOptions {
  double layer_thickness = 0.05;  // [mm]
  // Not 0: layers as thick as steps of this size on the surface allow [mm], in
  // multiples of layer_thickness up to max_layer.
  double adaptive = 0;
  double max_layer = 0;         // [mm]; 0: 4 times layer_thickness
  std::vector<double> heights;  // not empty: sections at exactly these
  double tolerance = 0.001;     // [mm]; 0 keeps all vertices
  // [mm] inwards; negative: outwards; 0: that of the material.
  double compensation = 0;
  unsigned threads = 0;  // 0: as many as the machine has
};

// How layers are drawn, for formats of images.
struct ImageOptions {
  // Whose panel: a name or a profile; empty: the design's, or the format's.
  std::string printer;
  bool mirror_x = false;  // turned over
  bool mirror_y = false;
};

// A solid, read and evaluated once, to be sliced as often as needed, by several
// threads at a time if need be.
class Design {
 public:
  // Reads a .scad or .csg file. Throws where the design has errors, is empty,
  // or is flat.
  static Design from_file(const std::string& path,
                          const DesignOptions& options = {});
  // Reads a text instead. Messages call it `name`, and it finds its files from
  // there.
  static Design from_text(const std::string& text,
                          const DesignOptions& options = {},
                          const std::string& name = "design.scad");

  // The design with other values, read and evaluated anew; those that are not
  // named stay as they are.
  Design with(const ParameterValues& values) const;

  Design(Design&&) noexcept;
  Design& operator=(Design&&) noexcept;
  ~Design();

  // All layers, the lowest first.
  std::vector<Layer> slice(const SliceOptions& options = {}) const;

  // Hands all layers on, one by one as they are ready: memory does not grow
  // with their number. `take` is called by one thread at a time, not always the
  // caller's.
  void slice(const SliceOptions& options,
             const std::function<void(const Layer&)>& take) const;

  // To the output whose format its extension says: contours as in ring.slc,
  // images as in ring.sl1 or ring.png, a folder. It appears whole or not at
  // all, and never in the place of a file that the design was read from.
  void write(const std::string& path, const SliceOptions& options = {},
             const ImageOptions& images = {}) const;

  // Walls and gaps thinner than `width` [mm], from the bottom to the top.
  std::vector<ThinPlace> find_thin_places(
      double width, const SliceOptions& options = {}) const;

  // What `lamina check` finds: what would go wrong in the print, from the
  // bottom to the top. All layers must be sliced, so `heights` must be empty.
  std::vector<Finding> check(const SliceOptions& options = {},
                             double self_supporting = 0) const;

  // What `lamina inspect` says of the layers as they are written.
  Inspection inspect(const SliceOptions& options = {},
                     const InspectOptions& wanted = {}) const;

  // What the piece weighs, costs and takes, and what is wrong with it, as JSON:
  // a quote of docs/serve.md.
  std::string report(const SliceOptions& options = {},
                     const InspectOptions& wanted = {}) const;

  // The page of `lamina view -o x.html`, which shows layers and solid.
  std::string page(const SliceOptions& options = {}) const;

  // What was added, in no order.
  std::vector<Support> supports() const;

  // What the customizer offers, in the order of the design, with the values of
  // the design or of the parameter set.
  const std::vector<Parameter>& parameters() const;

 private:
  struct State;
  explicit Design(std::unique_ptr<const State> state);

  std::unique_ptr<const State> state_;
};

// What `lamina inspect` says of a file of layers.
Inspection inspect_file(const std::string& path,
                        const InspectOptions& wanted = {});

}  // namespace lamina
