#pragma once
// Random designs, as text, for judges and laws: the same seed, or the same
// bytes, give the same text on every machine.

#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/support/choices.h"

namespace lamina::support {

enum class RandomKind {
  // Everything on a grid of 1/4 mm, right angles only: many faces coincide, and
  // their doubles agree exactly.
  kGrid,
  // Such a design turned as a whole: faces coincide but for rounding.
  kTurnedGrid,
  // Sizes, places and transforms at random: nothing coincides.
  kGeneric,
  // Plates and slots down to 1e-4 mm, turned at random about z.
  kThin,
  // As kGrid, but leaves are off the grid by one distance between 1e-9 and
  // 1e-5 mm: faces are neither the same nor well apart.
  kNear,
  // Nearly all modules of the language: random_modules.h.
  kModules,
};
inline constexpr int kRandomKindCount = 6;

const char* name_of(RandomKind kind);

// leaf_count  how many leaves, at least 1
std::string random_design(RandomKind kind, Choices& choices,
                          std::size_t leaf_count);
std::string random_design(RandomKind kind, std::uint32_t seed,
                          std::size_t leaf_count);

}  // namespace lamina::support
