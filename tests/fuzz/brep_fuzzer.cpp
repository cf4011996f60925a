// BREP, as text and binary.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/cad.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  fuzz::read_part(fuzz::as_text(data, size), cad::Format::kBrep);
  return 0;
}
