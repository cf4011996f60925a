#include "tests/oracle/openscad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <unistd.h>

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

// FNV-1a.
std::uint64_t hash(const std::string& text) {
  std::uint64_t value = 0xcbf29ce484222325;
  for (const char c : text) {
    value ^= static_cast<unsigned char>(c);
    value *= 0x100000001b3;
  }
  return value;
}

// Runs openscad with `arguments`; its output goes to `log`.
void run(const std::string& arguments, const fs::path& log) {
  const std::string command =
      fmt::format("openscad {} > '{}' 2>&1", arguments, log.string());
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error(
        fmt::format("failed: {}\n{}", command, read_file(log)));
  }
}

float read_float(const char* bytes) {
  float value = 0;
  std::memcpy(&value, bytes, sizeof value);
  return value + 0.0F;  // -0 becomes 0
}

}  // namespace

csg::Mesh render_with_openscad(const fs::path& design, const fs::path& cache) {
  fs::create_directories(cache);
  const std::string unique = fmt::format("{}.tmp", ::getpid());
  const fs::path log = cache / (unique + ".log");
  run("--version", log);
  const fs::path stl =
      cache / fmt::format("{}-{:016x}.stl", design.stem().string(),
                          hash(read_file(log) + read_file(design)));
  if (!fs::exists(stl)) {
    const fs::path beside = cache / (unique + ".stl");
    run(fmt::format("--export-format binstl -o '{}' '{}'", beside.string(),
                    design.string()),
        log);
    fs::rename(beside, stl);
  }
  fs::remove(log);
  return read_binary_stl(stl);
}

csg::Mesh read_binary_stl(const fs::path& path) {
  constexpr std::size_t kHeader = 80;
  constexpr std::size_t kRecord = 50;
  const std::string bytes = read_file(path);
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
