#pragma once
// Random designs, as text, for the judges: the same seed gives the same text
// on every machine.

#include <cstdint>
#include <string>

namespace lamina::oracle {

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
};
inline constexpr int kRandomKindCount = 5;

const char* name_of(RandomKind kind);

// leaf_count  how many leaves, at least 1
std::string random_design(RandomKind kind, std::uint32_t seed,
                          std::size_t leaf_count);

}  // namespace lamina::oracle
