#pragma once
// How a part should lie: hundreds of directions judged by what they would print
// like.
//
// 1. Directions spread evenly over the sphere (a Fibonacci lattice), and the
// six
//    axes, are sliced in coarse layers: how high, what hangs over, what traps
//    resin.
// 2. Around the best of these, finer ones.
// 3. For the best of all supports are planned, in layers as they are printed:
//    how much resin they take, how much of the part they touch.
//
// What is best depends on the maker, so all are listed that no other beats in
// everything (a Pareto list). First comes the one whose figures, each beside
// the least of its kind, have the least sum.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compiler/compilation.h"

namespace lamina::compiler {

struct JudgedDirection {
  Vec3 up = Vec3(0, 0, 1);  // in the design, of length 1
  double height = 0;        // [mm]
  std::size_t layers = 0;
  std::size_t islands = 0;  // without supports
  double overhang = 0;      // of islands and overhangs, without supports [mm²]
  double cups = 0;          // of suction cups [mm³]
  // With supports.
  std::size_t contacts = 0;
  double contact_area = 0;    // [mm²]
  double support_volume = 0;  // [mm³]
  std::size_t unheld = 0;     // places that no support reaches or may reach
  double seconds = 0;         // of the print; 0: not known
  // The part and its supports from the front, as an SVG drawing.
  std::string picture;
};

struct OrientOptions {
  std::size_t directions = 300;
  std::size_t planned = 40;  // for how many of them supports are planned
  std::optional<slicer::SupportSizes> sizes;  // a tip of 0: the material's
  // Called with how many steps are done, of how many.
  Progress on_progress;
};

struct OrientResult {
  JudgedDirection drawn;                // as the design has it
  std::vector<JudgedDirection> listed;  // the best first
  std::size_t judged = 0;
};

// No value where the design failed, which is reported. Throws GeometryError
// where it is nothing or flat.
std::optional<OrientResult> find_orientations(Compilation& compilation,
                                              const OrientOptions& options);

}  // namespace lamina::compiler
