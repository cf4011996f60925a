// Texts of surface(), to layers.

#include <cstddef>
#include <cstdint>

#include "csg/import/surface_file.h"
#include "tests/fuzz/geometry.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const auto bytes = fuzz::as_text(data, size);
  csg::make_surface(csg::parse_dat(bytes), true);
  fuzz::slice_surface(fuzz::write_input("input.dat", bytes));
  return 0;
}
