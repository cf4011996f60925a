#pragma once
// The lines of a design that made what was found in its layers.
//
// A contour knows the leaf that it is of, and the scene knows where the design
// calls that leaf's module, and from where that call came.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "csg/lower/lower.h"
#include "slicer/slice/slice.h"

namespace lamina::compiler {

struct SourceLine {
  struct Call {
    std::string module;
    std::string place;
  };
  std::string place;        // "ring.scad:12:3", of the leaf
  std::vector<Call> calls;  // modules around it, innermost first
};

// Of a thin feature, the lines of the leaves at both sides, once if they are
// equal; of a finding, one line. None where the leaf is not known.
using SourceLines = std::vector<SourceLine>;

struct FoundLines {
  std::vector<SourceLines> features;  // of each of SliceReport::features
  std::vector<SourceLines> findings;  // of each finding of SliceReport::print
  std::vector<SourceLines> contacts;  // of each of SliceReport::supports
};

// Nothing for an outline, which has no leaves.
FoundLines find_lines(const csg::Lowered& lowered,
                      const slicer::SliceReport& report);

// The lines of two leaves of a scene, in the order of the design, once if they
// are equal. Of kNoInstance there is none.
SourceLines lines_of(const csg::Scene& scene, std::uint32_t a, std::uint32_t b);

// The line of a leaf: "lib.scad:8:5 from ring.scad:40:3".
std::string line_text(const csg::Instance& instance);

// All of them, separated by commas.
std::string text_of(const SourceLines& lines);

// As pages have it, which go to other machines: files are named from this
// folder.
std::string text_from(const std::string& folder, SourceLines lines);

// A text for each: "lib.scad:8:5 from ring.scad:40:3, ring.scad:12:3".
std::vector<std::string> texts_of(std::span<const SourceLines> all);

}  // namespace lamina::compiler
