// SVG drawings, filled, stroked and sliced.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/geometry.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  fuzz::slice_import(fuzz::write_input("input.svg", fuzz::as_text(data, size)),
                     csg::ImportFormat::kSvg);
  return 0;
}
