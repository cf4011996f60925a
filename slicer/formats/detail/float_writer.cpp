#include "slicer/formats/detail/float_writer.h"

#include <bit>

#include <fmt/format.h>

#include "base/diagnostic.h"

namespace lamina::slicer {

static_assert(std::endian::native == std::endian::little,
              "SLC and CLI are little-endian and written as numbers lie in "
              "memory");

void FloatWriter::check_rise(float before, double height) const {
  if (static_cast<float>(height) > before) return;
  throw FileError(
      fmt::format("Can't write '{}': the layers at {} and {} mm "
                  "are one in {}'s 32-bit numbers",
                  output_.path(), before, height, format_));
}

}  // namespace lamina::slicer
