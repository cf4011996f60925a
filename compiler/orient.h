#pragma once
// How a part should lie: hundreds of directions judged by what they would print
// like.
//
// 1. Directions spread evenly over the sphere (a Fibonacci lattice), and the
//    six axes, are sliced in coarse layers: how high, what hangs over, what
//    traps resin.
// 2. Around the best of these, finer ones.
// 3. For the best of all supports are planned, in layers as they are printed:
//    how much resin they take, how much of the part they touch.
//
// What is best depends on the maker, so all are listed that no other beats in
// everything (a Pareto list). First comes the one whose figures, each beside
// the least of its kind, have the least sum.
//
// A direction is judged as its text has it, in thousandths: a run with
// `--orient X,Y,Z` prints what was judged.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/compilation.h"

namespace lamina::compiler {

struct JudgedDirection {
  Vec3 up = Vec3(0, 0, 1);  // in the design, in thousandths; nearly of length 1
  Vec2 base = Vec2(0);      // width and depth, without supports [mm]
  double height = 0;        // [mm]
  std::size_t layers = 0;
  std::size_t islands = 0;  // without supports
  double overhang = 0;      // of islands and overhangs, without supports [mm²]
  double cups = 0;          // of suction cups [mm³]
  // With supports, where these were planned.
  bool is_planned = false;
  std::size_t contacts = 0;
  double contact_area = 0;    // [mm²]
  double visible_area = 0;    // of that, on leaves with $visible [mm²]
  double support_volume = 0;  // [mm³]
  std::size_t unheld = 0;     // places that no support reaches or may reach
  double seconds = 0;         // of the print; 0: not known
  std::string picture;        // as OrientOptions::draw makes it
};

struct OrientOptions {
  std::size_t directions = 300;
  std::size_t planned = 40;  // for how many of them supports are planned
  std::optional<slicer::SupportSizes> sizes;  // a tip of 0: the material's
  // Called with how many steps are done, of how many.
  Progress on_progress;
  // Draws the part and its supports; empty: there are no pictures.
  std::function<std::string(std::span<const slicer::Layer>,
                            const slicer::SupportPlan&)>
      draw;
  // Asked before each direction, by any thread: true ends the search with what
  // has been judged. Empty: nothing ends it.
  std::function<bool()> should_stop;
};

struct OrientResult {
  std::optional<JudgedDirection> drawn;  // as the design has it; if judged
  // The best first: of those with supports, where supports were planned for
  // some; of those that fit the printer, where some do. Empty where the search
  // was stopped before anything was judged.
  std::vector<JudgedDirection> listed;
  std::size_t judged = 0;
  std::size_t planned = 0;   // of these
  bool has_visible = false;  // whether a leaf has $visible
  bool is_stopped = false;
};

// The compilation's design is turned by nothing but the search. No value where
// it failed, which is reported. Throws GeometryError where it is nothing or
// flat.
std::optional<OrientResult> find_orientations(Compilation& compilation,
                                              const OrientOptions& options);

// The direction that the request asks for by its place in that list. No value
// where the design fails or is flat: the run itself will say why. Throws
// GeometryError where the list is shorter.
std::optional<FoundDirection> find_direction(const Request& request,
                                             std::size_t evaluation_stack,
                                             TemporaryFiles& files);

// "-0.25,0.5,0.829": the direction as --orient takes it.
std::string direction_text(Vec3 up);

}  // namespace lamina::compiler
