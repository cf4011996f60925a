// Layers of .layers.json files.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input.h"
#include "tests/fuzz/layers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace lamina::fuzz;
  read_layers(write_input("input.layers.json", as_text(data, size)));
  return 0;
}
