// random_suite <kind> <first seed> <count>: tries designs of one kind and
// prints a row of a table; complaints go to stderr. Exit status 1 if any.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <fmt/format.h>

#include "tests/oracle/random_suite.h"

namespace lamina::oracle {
namespace {

int run(const std::string& kind_name, std::uint32_t first,
        std::uint32_t count) {
  for (int k = 0; k < support::kRandomKindCount; ++k) {
    const auto kind = static_cast<RandomKind>(k);
    if (kind_name != name_of(kind)) continue;
    SuiteTally tally;
    for (std::uint32_t seed = first; seed < first + count; ++seed) {
      const std::string complaint =
          try_design(kind, seed, suite_layer_count(seed), tally);
      if (!complaint.empty()) fmt::print(stderr, "{}\n", complaint);
    }
    fmt::print("{} {} {} {} {} {} {} {}\n", kind_name, tally.designs,
               tally.empty_designs, tally.leaves, tally.sections, tally.layers,
               tally.probes, tally.failures);
    return tally.failures == 0 ? 0 : 1;
  }
  fmt::print(stderr, "no such kind: {}\n", kind_name);
  return 2;
}

}  // namespace
}  // namespace lamina::oracle

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: random_suite <kind> <first seed> <count>\n");
    return 2;
  }
  const auto number = [](const char* text) {
    return static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
  };
  try {
    return lamina::oracle::run(argv[1], number(argv[2]), number(argv[3]));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
