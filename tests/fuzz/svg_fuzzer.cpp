// SVG drawings.

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/file/format_error.h"
#include "csg/import/svg.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  csg::SvgOptions options;
  options.center = true;
  options.outline = [](std::span<const Vec2>, const csg::SvgStroke&) {
    return csg::SvgContours();
  };
  try {
    csg::parse_svg(fuzz::as_text(data, size), options);
  } catch (const FormatError&) {
  }
  return 0;
}
