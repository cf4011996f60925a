#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "base/file/format_error.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/mesh_file.h"
#include "csg/vertex_table.h"

namespace lamina::csg {
namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes and the number of facets
constexpr std::size_t kRecord = 50;  // normal, three corners, two bytes
constexpr std::size_t kNormal = 12;

// Little-endian, as every machine that this is built for.
std::uint32_t facet_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  return count;
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= kHeader &&
         bytes.size() == kHeader + kRecord * std::size_t{facet_count(bytes)};
}

// Joins equal corners at once: there are six times as many as vertices, and a
// large file needs most of its memory for them. Most facets share two corners
// with the one before; only the other corners are looked up, many at a time.
class FacetJoiner {
 public:
  // count  of facets; a guess
  explicit FacetJoiner(std::size_t count) : vertices_(count / 2 + 3) {
    triangles_.reserve(count);
    corners_.back() = Vec3(std::numeric_limits<double>::quiet_NaN());
    last_.fill(kAtOnce);
  }

  void add(const std::array<Vec3, 3>& corners) {
    if (waiting_ + 3 > kAtOnce) join();
    const std::array<std::uint32_t, 3> places = {
        place_of(corners[0]), place_of(corners[1]), place_of(corners[2])};
    last_ = places;
    triangles_.push_back(places);
  }

  RawMesh take() {
    join();
    return {{vertices_.take_points(), std::move(triangles_)}, {}, true};
  }

 private:
  // The corner's place among those that wait.
  std::uint32_t place_of(const Vec3& corner) {
    for (const std::uint32_t place : last_) {
      if (corners_[place] == corner) return place;
    }
    corners_[waiting_] = corner;
    return waiting_++;
  }

  // Names the corners that wait, in the triangles that have places for names.
  void join() {
    std::array<std::uint32_t, kAtOnce> names{};
    vertices_.name(std::span(corners_).first(waiting_), names);
    for (; joined_ < triangles_.size(); ++joined_) {
      for (std::uint32_t& corner : triangles_[joined_]) corner = names[corner];
    }
    waiting_ = 0;
    last_.fill(kAtOnce);
  }

  static constexpr std::uint32_t kAtOnce = 96;  // corners

  VertexTable vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::size_t joined_ = 0;  // of triangles_
  // Those that wait; the last one equals none.
  std::array<Vec3, kAtOnce + 1> corners_{};
  std::uint32_t waiting_ = 0;
  std::array<std::uint32_t, 3> last_{};  // places of the last facet's corners
};

// The facets of a binary file.
class BinaryFacets {
 public:
  explicit BinaryFacets(std::string_view bytes)
      : records_(bytes.data() + kHeader), count_(facet_count(bytes)) {}

  std::uint32_t count() const { return count_; }

  std::array<Vec3, 3> corners(std::uint32_t facet) const {
    std::array<float, 9> n{};
    std::memcpy(n.data(), record(facet) + kNormal, sizeof n);
    return {Vec3(n[0], n[1], n[2]), Vec3(n[3], n[4], n[5]),
            Vec3(n[6], n[7], n[8])};
  }
  glm::vec3 first_corner(std::uint32_t facet) const {
    glm::vec3 corner;
    std::memcpy(&corner, record(facet) + kNormal, sizeof corner);
    return corner;
  }
  void prefetch(std::uint32_t facet) const {
    __builtin_prefetch(record(facet));
    __builtin_prefetch(record(facet) + kRecord - 1);
  }

 private:
  const char* record(std::uint32_t facet) const {
    return records_ + kRecord * facet;
  }

  const char* records_;
  std::uint32_t count_;
};

// --- Order ------------------------------------------------------------------
// Programs write facets in some order along the surface, and all that follows
// profits: neighbours meet in the processor's caches, and layers meet runs of
// facets. A file whose facets stand in no order is read in that of the cells of
// a grid, which costs less than random access.

constexpr std::uint32_t kFewFacets = 1 << 14;  // fit into a cache anyway
constexpr std::uint32_t kSamples = 1 << 10;

float distance(glm::vec3 a, glm::vec3 b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
}

// Whether the next facet is hardly nearer than any other one.
bool is_scattered(const BinaryFacets& facets) {
  constexpr float kHardlyNearer = 0.25F;
  const std::uint32_t count = facets.count();
  if (count < kFewFacets) return false;
  float to_next = 0;
  float to_any = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const std::uint32_t facet = i * (count / kSamples);
    const glm::vec3 corner = facets.first_corner(facet);
    to_next += distance(corner, facets.first_corner(facet + 1));
    to_any +=
        distance(corner, facets.first_corner((facet + count / 2) % count));
  }
  return to_next > kHardlyNearer * to_any;
}

// Cells of a grid over the facets, numbered so that neighbours have numbers
// close to each other.
class CellGrid {
 public:
  static constexpr std::uint32_t kCellCount = 1 << 18;

  explicit CellGrid(const BinaryFacets& facets) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const auto corner = facets.first_corner(i * (facets.count() / kSamples));
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
    low_ = low;
    cells_per_mm_ = glm::vec3(kCellsASide) / (high - low);
  }

  std::uint32_t cell_of(glm::vec3 point) const {
    const glm::vec3 place = (point - low_) * cells_per_mm_;
    return spread(place.x) << 2 | spread(place.y) << 1 | spread(place.z);
  }

 private:
  static constexpr std::uint32_t kCellsASide = 64;

  // The bits of the cell's number along an axis, each with two free places.
  static std::uint32_t spread(float place) {
    const bool is_inside = place > 0;  // false for NaN
    std::uint32_t bits = is_inside
                             ? static_cast<std::uint32_t>(std::min(
                                   place, static_cast<float>(kCellsASide - 1)))
                             : 0;
    bits = (bits | bits << 8) & 0x0000f00fU;
    bits = (bits | bits << 4) & 0x000c30c3U;
    return (bits | bits << 2) & 0x00249249U;
  }

  glm::vec3 low_;
  glm::vec3 cells_per_mm_;
};

// All facets, those of a cell in the order of the file.
std::vector<std::uint32_t> order_by_cells(const BinaryFacets& facets) {
  const CellGrid grid(facets);
  std::vector<std::uint32_t> cells(facets.count());
  std::vector<std::uint32_t> places(CellGrid::kCellCount);
  for (std::uint32_t i = 0; i < facets.count(); ++i) {
    cells[i] = grid.cell_of(facets.first_corner(i));
    ++places[cells[i]];
  }
  std::exclusive_scan(places.begin(), places.end(), places.begin(), 0U);
  std::vector<std::uint32_t> order(facets.count());
  for (std::uint32_t i = 0; i < facets.count(); ++i) {
    order[places[cells[i]]++] = i;
  }
  return order;
}

RawMesh parse_binary(std::string_view bytes) {
  const BinaryFacets facets(bytes);
  FacetJoiner joiner(facets.count());
  if (!is_scattered(facets)) {
    for (std::uint32_t i = 0; i < facets.count(); ++i) {
      joiner.add(facets.corners(i));
    }
    return joiner.take();
  }
  constexpr std::size_t kAhead = 16;
  const std::vector<std::uint32_t> order = order_by_cells(facets);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + kAhead < order.size()) facets.prefetch(order[i + kAhead]);
    joiner.add(facets.corners(order[i]));
  }
  return joiner.take();
}

bool holds(std::string_view line, std::string_view words) {
  return line.find(words) != std::string_view::npos;
}

enum class LineKind { kIgnored, kLoop, kOther };

LineKind kind_of(std::string_view line) {
  if (line.starts_with("vertex ")) return LineKind::kOther;  // most lines
  if (line.empty() || holds(line, "solid") || holds(line, "facet") ||
      holds(line, "endloop")) {
    return LineKind::kIgnored;
  }
  return holds(line, "outer loop") ? LineKind::kLoop : LineKind::kOther;
}

[[noreturn]] void fail(const TextLines& lines, std::string_view fault,
                       std::string_view line) {
  constexpr std::size_t kMostShown = 80;
  throw FormatError(fmt::format("STL line {}, {} vertex line '{}'",
                                lines.number(), fault,
                                line.substr(0, kMostShown)));
}

// Reads the numbers behind "vertex"; nothing where there are less than three
// words.
std::optional<Vec3> read_vertex(std::string_view line, const TextLines& lines) {
  std::string_view rest = line.substr(line.find("vertex") + 6);
  Vec3 vertex(0);
  for (int i = 0; i < 3; ++i) {
    const bool is_apart = !rest.empty() && is_blank(rest.front());
    const std::string_view word = take_word(rest);
    if (word.empty() || !is_apart) return std::nullopt;
    const std::optional<double> number = to_number<double>(word);
    if (!number) fail(lines, "can't parse", line);
    vertex[i] = *number;
  }
  return vertex;
}

RawMesh parse_text(std::string_view bytes) {
  FacetJoiner facets(0);
  TextLines lines(bytes);
  lines.next();  // the name
  std::array<Vec3, 3> corners{};
  std::size_t count = 0;
  while (const auto line = lines.next()) {
    const LineKind kind = kind_of(*line);
    if (kind == LineKind::kLoop) count = 0;
    if (kind != LineKind::kOther) continue;
    if (count >= 3) fail(lines, "extra", *line);
    if (!holds(*line, "vertex")) continue;
    const std::optional<Vec3> vertex = read_vertex(*line, lines);
    if (!vertex) continue;
    corners[count] = *vertex;
    if (++count < 3) continue;
    facets.add(corners);
  }
  return facets.take();
}

}  // namespace

RawMesh parse_stl(std::string_view bytes) {
  if (is_binary(bytes)) return parse_binary(bytes);
  if (bytes.starts_with("solid")) return parse_text(bytes);
  throw FormatError(
      bytes.size() < kHeader
          ? "STL file is neither text nor a whole header"
          : fmt::format(
                "STL file of {} facets should be {} bytes long, not {},",
                facet_count(bytes),
                kHeader + kRecord * std::size_t{facet_count(bytes)},
                bytes.size()));
}

}  // namespace lamina::csg
