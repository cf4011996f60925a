#include "tests/oracle/openscad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "tests/support/openscad_cache.h"
#include "tests/support/temporary_folder.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

float read_float(const char* bytes) {
  float value = 0;
  std::memcpy(&value, bytes, sizeof value);
  return value + 0.0F;  // -0 becomes 0
}

}  // namespace

csg::Mesh render_with_openscad(const fs::path& design) {
  const support::OpenScadResult result =
      support::ask_openscad(design, "stl", {"--export-format", "binstl"});
  if (result.output.empty()) {
    throw std::runtime_error(
        fmt::format("openscad fails on {}\n{}", design.string(), result.words));
  }
  return read_binary_stl(result.output);
}

csg::Mesh read_binary_stl(const fs::path& path) {
  constexpr std::size_t kHeader = 80;
  constexpr std::size_t kRecord = 50;
  const std::string bytes = support::read_file(path.string());
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader + 4) {
    std::memcpy(&count, bytes.data() + kHeader, 4);
  }
  if (bytes.size() != kHeader + 4 + count * kRecord) {
    throw std::runtime_error(path.string() + " is no binary STL file");
  }

  csg::Mesh mesh;
  std::map<std::tuple<float, float, float>, std::uint32_t> indices;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      // The normal comes first.
      const char* corner =
          bytes.data() + kHeader + 4 + t * kRecord + 12 * (i + 1);
      const std::tuple key(read_float(corner), read_float(corner + 4),
                           read_float(corner + 8));
      const auto [it, is_new] = indices.try_emplace(
          key, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        const auto [x, y, z] = key;
        mesh.vertices.push_back({x, y, z});
      }
      triangle[i] = it->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

double float32_spacing(const csg::Mesh& mesh) {
  float largest = 0;
  for (const Vec3& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) {
      largest = std::max(largest, static_cast<float>(std::abs(vertex[i])));
    }
  }
  return std::nextafter(largest, std::numeric_limits<float>::infinity()) -
         largest;
}

}  // namespace lamina::oracle
