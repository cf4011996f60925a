// A law and its designs out of bytes: tests/support/scene_laws.h.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input.h"
#include "tests/support/scene_laws.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  support::ByteChoices choices({data, size});
  const auto count = static_cast<std::uint32_t>(support::law_count());
  const std::uint32_t law = choices.below(count);
  support::LawTally tally;
  const std::string complaint =
      support::try_law(law, support::draw_operands(law, choices), tally);
  fuzz::require(complaint.empty(), complaint);
  return 0;
}
