#pragma once
// Judges lamina's layers of a design by the mesh that openscad makes of it.
//
// In every section regions and holes must be equal, and the symmetric
// difference within openscad's own rounding times the perimeter: its 2D grid
// and its float32 numbers. What is thinner than that is not counted. A mesh
// that is open or overlaps itself in a section that differs, or that openscad
// left a part out of, is no judge of that design.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "csg/scene.h"
#include "tests/conformance/reference.h"

namespace lamina::conformance {

struct Judgement {
  std::string verdict;    // equal, empty, no-judge, differs
  std::string complaint;  // where it is neither equal nor empty
};

struct Design {
  std::filesystem::path path;
  std::string language;  // 2021, 2026 or auto
};

// `count` heights spread over the mesh, each far from all of its vertices.
std::vector<double> generic_heights(const csg::Mesh& mesh, std::size_t count);

// Runs lamina on `design` for its sections at `heights`, which rise.
Judgement judge_solid(const Reference& reference, const Design& design,
                      const std::vector<double>& heights);

// Of a 2D design, whose mesh is its outline, extruded from 0 to 1.
Judgement judge_outline(const Reference& reference, const Design& design);

// Where openscad makes nothing of the design.
Judgement judge_empty(const Reference& reference, const Design& design);

}  // namespace lamina::conformance
