// STL, as text and as binary, to layers.

#include <cstddef>
#include <cstdint>

#include "csg/import/format_error.h"
#include "csg/import/stl.h"
#include "tests/fuzz/geometry.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const auto bytes = fuzz::as_text(data, size);
  try {
    csg::parse_stl(bytes);
  } catch (const csg::FormatError&) {
    return 0;
  }
  fuzz::slice_import(fuzz::write_input("input.stl", bytes),
                     csg::ImportFormat::kStl);
  return 0;
}
