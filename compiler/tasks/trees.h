#pragma once
// Casting trees: pieces with sprues on a trunk, as a design.

#include <optional>
#include <span>
#include <string>

#include "compiler/compilation.h"
#include "slicer/casting/casting_tree.h"

namespace lamina::compiler {

// A piece with its sprues, as trees take it.
struct TreePart {
  slicer::TreePiece shape;
  std::string csg;    // the sprued design, as its .csg text
  double volume = 0;  // of the piece alone [mm³]
};

// Plans the sprues that the request asks for. No value where the design failed,
// which is reported. Throws GeometryError as plan_sprues() does.
std::optional<TreePart> make_tree_part(Compilation& compilation);

// The tree as a design that people can read and edit: a module for each part
// that it has, and a line for each piece.
//
// names  of the parts, for comments
std::string tree_text(const slicer::CastingTree& tree,
                      std::span<const TreePart> parts,
                      std::span<const std::string> names,
                      const slicer::TreeSizes& sizes);

// Of metal in a tree: all pieces, sprues, trunk and foot, about [mm³].
double tree_volume(const slicer::CastingTree& tree,
                   std::span<const TreePart> parts,
                   const slicer::TreeSizes& sizes);

}  // namespace lamina::compiler
