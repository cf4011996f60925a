// Layers of SLC files.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input.h"
#include "tests/fuzz/layers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace lamina::fuzz;
  read_layers(write_input("input.slc", as_text(data, size)));
  return 0;
}
