#pragma once
// Preflight: what a casting house asks before it takes a piece.
//
// Is any wall, wire or gap thinner than the metal allows, or an engraving
// shallower; what does the piece weigh; does metal reach its heavy places; how
// large is it, and the finger that it fits. All of it is measured of the solid
// that would come out of the printer: what is compensated comes out as drawn.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compiler/compilation.h"
#include "compiler/tasks/stones.h"
#include "parser/customizer/customizer.h"
#include "slicer/machine/material.h"
#include "slicer/thickness/engravings.h"
#include "slicer/thickness/feeding.h"
#include "slicer/thickness/solid_samples.h"
#include "slicer/thickness/thin_places.h"

namespace lamina::compiler {

// What is thinner than the metal allows.
struct TooThin {
  slicer::ThinPlace place;
  double least = 0;  // that the metal asks for [mm]
  SourceLines lines;
};

// An engraving that is shallower than the metal allows.
struct TooShallow {
  slicer::Engraving engraving;
  double least = 0;  // depth that the metal asks for [mm]
  SourceLines lines;
};

// A heavy place that metal does not reach.
struct Unfed {
  slicer::Pool pool;
  SourceLines lines;  // that make the neck
};

struct PreflightOptions {
  // Where metal enters; none: at the thickest place.
  std::vector<slicer::Gate> gates;
};

struct Preflight {
  slicer::Material metal;
  // That and the usual ones, of which weights are given too.
  std::vector<slicer::Material> metals;
  std::vector<slicer::Layer> layers;  // of the piece
  Box3 box;
  double volume = 0;  // [mm³]
  double area = 0;    // of the surface, up to some percent [mm²]
  // Diameter of the largest circle in the finger's hole [mm]; 0: there is none
  // of a finger's size.
  double finger = 0;
  // The thinnest first, by more than a twentieth. Places smaller than a square
  // of the least are too small to matter: crevices where surfaces meet are
  // such.
  std::vector<TooThin> too_thin;
  std::size_t edges = 0;  // that taper to nothing, and are not listed
  // The shallowest first, by more than a twentieth, but for those with a floor
  // smaller than a square of the least gap.
  std::vector<TooShallow> too_shallow;
  double thickest = 0;  // diameter of the largest ball inside [mm]
  // What is not fed, the largest first, and where metal enters.
  std::vector<Unfed> unfed;
  std::vector<slicer::Gate> gates;
  // Cells of the piece, and by their number whether metal reaches them.
  slicer::SolidCells cells;
  std::vector<bool> is_reached;
  std::vector<CustomizerEntry> parameters;
  std::vector<StoneParameter> stones;  // those of the parameters
  double pitch = 0;  // of the rays that measured thickness [mm]

  // Whether the metal allows all measures.
  bool is_ready() const { return too_thin.empty() && too_shallow.empty(); }
};

// An engraving is no wider than its depth should be, times this.
inline constexpr double kWidestEngraving = 2;

// Ring sizes of an inner diameter [mm]: the circumference [mm] in Europe (ISO
// 8653), and that of the USA, of which each is 0.032 inches wider.
double european_ring_size(double diameter);
double american_ring_size(double diameter);

// No value where the design failed, which is reported. Throws GeometryError
// where it is nothing or flat, and RequestError where no metal is named that
// says what it asks for.
std::optional<Preflight> preflight(Compilation& compilation,
                                   const PreflightOptions& options);

}  // namespace lamina::compiler
