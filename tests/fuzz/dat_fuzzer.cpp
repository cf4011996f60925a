// Texts of surface().

#include <cstddef>
#include <cstdint>

#include "csg/import/surface_file.h"
#include "csg/limits.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  try {
    csg::make_surface(csg::parse_dat(fuzz::as_text(data, size)), true);
  } catch (const plane::LimitExceeded&) {
  }
  return 0;
}
