// AMF, plain and zipped.

#include <cstddef>
#include <cstdint>

#include "base/file/format_error.h"
#include "csg/import/mesh_file.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  try {
    for (const csg::RawMesh& raw :
         csg::parse_amf(fuzz::as_text(data, size), "input.amf",
                        csg::Placing::kFile)
             .bodies) {
      fuzz::require(raw.count_stray_corners() == 0, "corners are vertices");
    }
  } catch (const FormatError&) {
  }
  return 0;
}
