// Any facets at all, imported and sliced. Corners lie on a small grid, where
// they often meet, fall together, and cross the layers' heights.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "tests/fuzz/geometry.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kCoordinates = 9;  // of a facet, a byte each

// The bytes of a value.
template <typename Value>
void append(const Value& value, std::string& bytes) {
  std::array<char, sizeof(Value)> copy{};
  std::memcpy(copy.data(), &value, sizeof(Value));
  bytes.append(copy.data(), copy.size());
}

std::string binary_stl(const std::uint8_t* data, std::size_t size) {
  const std::size_t facets = size / kCoordinates;
  std::string bytes(kHeader, ' ');
  append(static_cast<std::uint32_t>(facets), bytes);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    append(std::array<float, 3>{}, bytes);  // normal
    for (std::size_t i = 0; i < kCoordinates; ++i) {
      append(static_cast<float>(data[facet * kCoordinates + i]), bytes);
    }
    append(std::uint16_t{0}, bytes);
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  fuzz::slice_import(fuzz::write_input("input.stl", binary_stl(data, size)),
                     csg::ImportFormat::kStl);
  return 0;
}
