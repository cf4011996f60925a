#pragma once
// Tries the laws of sets and of space on random designs. They need no oracle,
// so a minute tries thousands.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/choices.h"

namespace lamina::support {

// What a law is tried on: designs, or shapes of the plane.
struct Operands {
  std::string a;
  std::string b;
  std::string c;
  std::vector<double> heights;  // of the sections, ascending [mm]
};

struct LawTally {
  std::uint64_t trials = 0;
  std::uint64_t refused = 0;  // of these: with a design that has an error
  std::string last_refusal;
};

// How many laws there are, and their names.
std::size_t law_count();
const char* law_name(std::size_t law);

Operands draw_operands(std::size_t law, Choices& choices);

// returns  what is broken, with the operands; empty: nothing
std::string try_law(std::size_t law, const Operands& operands, LawTally& tally);

}  // namespace lamina::support
