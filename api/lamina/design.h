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
// A fault of the design or of a file is thrown as std::runtime_error, whose
// text is what the program lamina prints: a message with its place, its line
// and carets below it.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lamina {

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

// How a design is read. Names and defaults are those of the program's options
// (docs/usage.md).
struct DesignOptions {
  std::vector<std::string> definitions;  // of -D: "size=57"
  double chordal_error = 0;              // [mm]; 0: $fa and $fs decide
  double scale = 1;
  // Gets what the design echoes and what it is warned of, as the program
  // prints it, at once.
  std::function<void(std::string_view message)> show;
  // Holds lamina_text.so, which text() needs. The CMake target lamina::lamina
  // defines where it lies.
#ifdef LAMINA_MODULE_FOLDER
  std::string module_folder = LAMINA_MODULE_FOLDER;
#else
  std::string module_folder;
#endif
};

// How it is sliced.
struct SliceOptions {
  double layer_thickness = 0.05;  // [mm]
  std::vector<double> heights;    // not empty: sections at exactly these
  double tolerance = 0.001;       // [mm]; 0 keeps all vertices
  double compensation = 0;        // [mm] inwards; negative: outwards
  unsigned threads = 0;           // 0: as many as the machine has
};

// A solid, read and evaluated once, to be sliced as often as needed, by several
// threads at a time if need be.
class Design {
 public:
  // Reads a .scad or .csg file. Evaluation takes up to 6 MiB of the caller's
  // stack. Throws where the design has errors, is empty, or is flat.
  static Design from_file(const std::string& path,
                          const DesignOptions& options = {});
  // The same for a text at hand. Messages call it `name`, and it finds its
  // files from there.
  static Design from_text(const std::string& text,
                          const DesignOptions& options = {},
                          const std::string& name = "design.scad");

  Design(Design&&) noexcept;
  Design& operator=(Design&&) noexcept;
  ~Design();

  // All layers, the lowest first.
  std::vector<Layer> slice(const SliceOptions& options = {}) const;

  // The same, one by one as they are ready: memory does not grow with their
  // number. `take` is called by one thread at a time, not always the caller's.
  void slice(const SliceOptions& options,
             const std::function<void(const Layer&)>& take) const;

  // To a file of contours whose format its extension tells, such as ring.slc.
  // It appears whole or not at all.
  void write(const std::string& path, const SliceOptions& options = {}) const;

 private:
  struct State;
  explicit Design(std::unique_ptr<const State> state);

  std::unique_ptr<const State> state_;
};

}  // namespace lamina
