#pragma once
// Plates: pieces that were sliced by themselves, written together.

#include <optional>
#include <span>
#include <vector>

#include "compiler/compilation.h"
#include "slicer/plate/packer.h"

namespace lamina::compiler {

// A piece as plates take it: its lowest point at height 0.
struct PlatedPiece {
  std::vector<slicer::Layer> layers;
  slicer::SliceReport slice;

  double height() const { return layers.back().top; }
};

// Slices the compilation's design in layers that begin at height 0. No value
// where the design failed, where a strict run has warnings, or where --fail-on
// forbids what was found, which is reported. Throws GeometryError where it is
// nothing or flat.
std::optional<PlatedPiece> slice_for_plates(Compilation& compilation);

// Warns of what does not go together: the printer, the material, the format and
// the thickness of layers.
void warn_of_plates(const Request& request, const FileAccess& access,
                    Diagnostics& diagnostics);

// Writes a plate to the request's output, and returns the report of that.
//
// pieces      all pieces; their layers
// slices      what slicing each of them reported
// placements  of this plate
Report write_plate(const Request& request,
                   std::span<const std::vector<slicer::Layer>> pieces,
                   std::span<const slicer::SliceReport> slices,
                   std::vector<slicer::Placement> placements,
                   TemporaryFiles& files, Diagnostics& diagnostics);

}  // namespace lamina::compiler
