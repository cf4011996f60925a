#pragma once
// Defects of a layer that the reader of its file could stumble over.
//
// Loops of a layer must be closed, simple, disjoint and turned by their
// nesting: outer ones counter-clockwise, holes clockwise. Only edges that
// lie near each other are compared (plane/edge_tree.h), and what goes around a
// loop is known by the order of all edges (slicer/contour/edge_order.h), so a
// layer costs little more than in proportion to its edges. Coordinates are
// float32, which doubles subtract exactly, and orientations are exact too: a
// defect is one of the numbers in the file and not of this check.
//
// Loops may touch in a point (two squares corner to corner are two regions); to
// pass through each other there is a crossing.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer_file.h"

namespace lamina::slicer {

enum class DefectKind {
  kOpen,         // the last vertex is not the first
  kGap,          // the file counts gaps
  kRepeat,       // two equal neighbours
  kZeroArea,     //
  kCrossing,     // two edges cross or run along each other
  kOrientation,  // turned against its nesting
};

struct Defect {
  DefectKind kind;
  std::uint32_t loop;  // from 0
  Vec2 place;          // [mm]
};

// "is not closed"
std::string_view describe(DefectKind kind);

// All defects of a layer; empty for a sound one. Of crossings it reports
// kMostCrossings at most.
std::vector<Defect> find_defects(std::span<const WrittenLoop> loops);
constexpr std::size_t kMostCrossings = 100;

}  // namespace lamina::slicer
