// Images of surface(), to layers.

#include <cstddef>
#include <cstdint>

#include "csg/import/format_error.h"
#include "csg/import/surface_file.h"
#include "tests/fuzz/geometry.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

// Images may be large where their files are small; then reading is enough.
constexpr std::size_t kMostPixels = 10000;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const auto bytes = fuzz::as_text(data, size);
  try {
    const csg::HeightField field = csg::parse_png(bytes, false);
    if (field.heights.size() > kMostPixels) return 0;
  } catch (const csg::FormatError&) {
    return 0;
  }
  fuzz::slice_surface(fuzz::write_input("input.png", bytes));
  return 0;
}
