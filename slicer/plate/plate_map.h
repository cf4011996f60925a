#pragma once
// A map of plates: which piece lies where, for whoever takes them off.

#include <span>
#include <string>
#include <vector>

#include "slicer/plate/packer.h"

namespace lamina::slicer {

struct MappedPiece {
  std::string name;
  plane::Region footprint;
};

// A plate as an SVG drawing, seen from above, with a name on each piece.
//
// placements  of this plate
// size        of the plate [mm]
std::string plate_svg(std::span<const MappedPiece> pieces,
                      std::span<const Placement> placements, Vec2 size);

struct MappedPlate {
  std::string title;  // "plate-1.sl1: 12 pieces, 2 h 10 min"
  std::vector<Placement> placements;
};

// All plates as a page for browsers, with a list of what lies on each.
std::string plate_page(std::span<const MappedPiece> pieces,
                       std::span<const MappedPlate> plates, Vec2 size);

}  // namespace lamina::slicer
