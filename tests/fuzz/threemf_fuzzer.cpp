// 3MF, to layers.

#include <cstddef>
#include <cstdint>

#include "csg/import/format_error.h"
#include "csg/import/threemf.h"
#include "tests/fuzz/geometry.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const auto bytes = fuzz::as_text(data, size);
  try {
    csg::parse_3mf(bytes);
  } catch (const csg::FormatError&) {
    return 0;
  }
  fuzz::slice_import(fuzz::write_input("input.3mf", bytes),
                     csg::ImportFormat::k3mf);
  return 0;
}
