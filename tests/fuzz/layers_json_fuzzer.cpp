// Layers of .layers.json files, whose coordinates may be any: read, drawn and
// compared.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/input.h"
#include "tests/fuzz/layers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace lamina::fuzz;
  const auto path = write_input("input.layers.json", as_text(data, size));
  read_layers(path);
  use_layers(path);
  return 0;
}
