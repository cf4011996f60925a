// Images of surface().

#include <cstddef>
#include <cstdint>

#include "base/file/format_error.h"
#include "csg/import/surface_file.h"
#include "csg/limits.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  // Images may be large where their files are small; then reading is enough.
  constexpr std::size_t kMostPixels = 10000;
  try {
    const csg::HeightField field =
        csg::parse_png(fuzz::as_text(data, size), false);
    if (field.heights.size() <= kMostPixels) csg::make_surface(field, false);
  } catch (const FormatError&) {
  } catch (const plane::LimitExceeded&) {
  }
  return 0;
}
