// Layers of .layers.json files, whose coordinates may be any: read, drawn and
// compared.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input.h"
#include "tests/fuzz/layers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace lamina::fuzz;
  use_layers(
      read_layers(write_input("input.layers.json", as_text(data, size))));
  return 0;
}
