#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/letter_case.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/mesh_file.h"
#include "csg/mesh/vertex_table.h"

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
// Programs write facets in some order along the surface. A file in no order
// takes four times as long to read, and sorted first no less (decision 44).
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

RawMesh parse_binary(std::string_view bytes) {
  const std::size_t count = facet_count(bytes);
  FacetJoiner joiner(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 9> n{};
    std::memcpy(n.data(), bytes.data() + kHeader + kRecord * i + kNormal,
                sizeof n);
    joiner.add({Vec3(n[0], n[1], n[2]), Vec3(n[3], n[4], n[5]),
                Vec3(n[6], n[7], n[8])});
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

// A download that ended early would be sliced to a fragment.
void require_end(std::string_view bytes) {
  const std::size_t end = bytes.rfind("endsolid");
  const std::size_t last = bytes.rfind("vertex");
  if (last == std::string_view::npos) return;
  if (end == std::string_view::npos || end < last) {
    throw FormatError(
        "STL file that is cut off, without 'endsolid' at its end,");
  }
}

RawMesh parse_text(std::string_view bytes) {
  require_end(bytes);
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
  // Some programs write capitals.
  if (lower_case(bytes.substr(0, 5)) == "solid") {
    return parse_text(lower_case(bytes));
  }
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
