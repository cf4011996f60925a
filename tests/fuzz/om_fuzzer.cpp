// OM.

#include <cstddef>
#include <cstdint>

#include "base/file/format_error.h"
#include "csg/import/mesh_file.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  try {
    csg::parse_om(fuzz::as_text(data, size));
  } catch (const FormatError&) {
  }
  return 0;
}
