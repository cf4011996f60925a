// DXF drawings.

#include <cstddef>
#include <cstdint>

#include "base/file/format_error.h"
#include "csg/import/dxf.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  csg::DxfOptions options;
  options.fragments = [](double) { return 8; };
  options.most_lines =
      10'000;  // so that ellipses of many turns take no seconds
  try {
    const csg::DxfDrawing drawing =
        csg::parse_dxf(fuzz::as_text(data, size), options);
    csg::unknown_entity_warnings(drawing, "", "input.dxf");
  } catch (const FormatError&) {
  }
  return 0;
}
