#pragma once
// The limits of an evaluation and its choices.

#include <cstddef>
#include <cstdint>

#include "csg/text_measurer.h"
#include "csg/tree.h"
#include "parser/language.h"

namespace lamina::csg {

// More than any design needs; endless recursion gets there within a second.
inline constexpr std::uint32_t kMostNestedCalls = 300000;

struct EvaluateOptions {
  Language language = Language::k2021;
  // Whether to end where what runs was not written for 2021.01 (Tree::newer).
  bool finds_language = false;
  bool preview = true;     // $preview
  double time = 0;         // $t
  std::uint32_t seed = 0;  // of rands() without a seed
  // C++ stack that evaluation may use below the caller's frame. A call takes
  // about 700 bytes of it, more where it stands deep in an expression; 200,000
  // may be nested. Where either ends, so does the evaluation, with OpenSCAD's
  // error. Callers should run evaluate() on a thread with a large stack.
  std::size_t stack_bytes = std::size_t{6} << 20;
  // Calls and turns of loops that the evaluation may take. Fuzzers set it; the
  // program has --max-time.
  std::uint64_t max_steps = UINT64_MAX;
  // Calls of functions and modules that may be nested (`--max-depth`), as far
  // as the stack goes.
  std::uint32_t max_depth = kMostNestedCalls;
  // Nodes without children that may be made, left out later or not
  // (`--max-leaves`). On their way to the layers they take about 1 kB each.
  std::uint32_t max_leaves = 10'000'000;
  // Whether to warn of arguments for which a user's module has no parameter
  // (`--check-parameters`). Functions and built-in modules always warn.
  bool check_parameters = true;
  // Greatest distance of facets from what they stand for, where the evaluation
  // makes them: of FreeCAD files [mm].
  double chordal_error = kChordalErrorOfParts;
  // Whether the design is a file, and its text only imports it.
  bool is_file = false;
  // For textmetrics() and fontmetrics(), which give undef without it.
  TextMeasurer* text_measurer = nullptr;
  // Whether to warn of numbers outside their range
  // (`--check-parameter-ranges`).
  bool check_ranges = false;
};

}  // namespace lamina::csg
