// Texts of surface().

#include <cstddef>
#include <cstdint>

#include "csg/import/surface_file.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  // One long row makes all others long; then reading is enough.
  constexpr std::size_t kMostHeights = 10000;
  const csg::HeightField field = csg::parse_dat(fuzz::as_text(data, size));
  if (field.heights.size() <= kMostHeights) csg::make_surface(field, true);
  return 0;
}
