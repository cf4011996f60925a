// AMF, plain and zipped.

#include <cstddef>
#include <cstdint>

#include "csg/import/amf.h"
#include "csg/import/format_error.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  try {
    csg::parse_amf(fuzz::as_text(data, size), "input.amf");
  } catch (const csg::FormatError&) {
  }
  return 0;
}
