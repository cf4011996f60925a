#pragma once
// Differences in each other, as A - (B - (C - ...)): what each level is without
// the next one.

#include <cstdint>
#include <utility>
#include <vector>

#include "plane/program/boolean_program.h"

namespace lamina::plane {

struct DifferenceLevels {
  // Of each level, from the outermost on: the minuend, and what else is
  // subtracted from it.
  std::vector<BooleanProgram> programs;
  // Of each operand of the whole program: its level, and its number there.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places;
};

// The longest way down from the root along differences that are subtracted.
// There are no levels where the root is not a difference.
DifferenceLevels difference_levels(const BooleanProgram& program);

}  // namespace lamina::plane
