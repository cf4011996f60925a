#include <algorithm>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {
namespace {

class OffReader {
 public:
  explicit OffReader(std::string_view bytes)
      : lines_(bytes), most_lines_(bytes.size() / 2 + 1) {}

  RawMesh read() {
    read_header();
    const std::size_t vertices = read_count("number of vertices");
    const std::size_t faces = read_count("number of faces");
    RawMesh raw;
    // Reserve no more than the file can hold, whatever it promises.
    raw.mesh.vertices.reserve(std::min(vertices, most_lines_));
    raw.mesh.triangles.reserve(std::min(faces, most_lines_));
    for (std::size_t i = 0; i < vertices; ++i) {
      raw.mesh.vertices.push_back(read_vertex());
    }
    for (std::size_t i = 0; i < faces; ++i) read_face(raw);
    return raw;
  }

 private:
  [[noreturn]] void fail(std::string_view expected) const {
    throw FormatError(
        fmt::format("OFF line {}, expected {}", lines_.number(), expected));
  }

  // Goes on to the next line that holds something.
  void next_line(std::string_view expected) {
    do {
      const auto line = lines_.next();
      if (!line) fail(expected);
      rest_ = line->substr(0, line->find('#'));
    } while (trim(rest_).empty());
  }

  void read_header() {
    next_line("OFF");
    std::string_view rest = rest_;
    std::string_view kind = take_word(rest);
    if (to_number<std::uint32_t>(kind)) return;  // the numbers come at once
    rest_ = rest;
    for (const std::string_view prefix : {"ST", "C", "N"}) {
      if (kind.starts_with(prefix)) kind.remove_prefix(prefix.size());
    }
    is_homogeneous_ = kind.starts_with('4');
    if (is_homogeneous_) kind.remove_prefix(1);
    const bool has_dimension = kind.starts_with('n');
    if (has_dimension) kind.remove_prefix(1);
    // The first number may follow without a blank.
    if (kind.starts_with("OFF") && to_number<std::uint32_t>(kind.substr(3))) {
      const char* const number = kind.data() + 3;
      const char* const end = rest.data() + rest.size();
      rest_ = {number, static_cast<std::size_t>(end - number)};
      return;
    }
    if (kind != "OFF") fail("OFF, [ST][C][N][4][n]OFF");
    if (take_word(rest) == "BINARY") fail("text, not BINARY");
    if (has_dimension && read_count("the dimension") != 3) {
      fail("3 dimensions");
    }
  }

  // The counts may stand behind the header's word, or on lines below.
  std::size_t read_count(std::string_view expected) {
    if (trim(rest_).empty()) next_line(expected);
    const auto number = to_number<std::uint32_t>(take_word(rest_));
    if (!number) fail(expected);
    return *number;
  }

  double read_coordinate() {
    const auto number = to_number<double>(take_word(rest_));
    if (!number) fail("coordinates of a vertex");
    return *number;
  }

  Vec3 read_vertex() {
    next_line("coordinates of a vertex");
    const double x = read_coordinate();
    const double y = read_coordinate();
    const double z = read_coordinate();
    return Vec3(x, y, z) / (is_homogeneous_ ? read_coordinate() : 1.0);
  }

  void read_face(RawMesh& raw) {
    next_line("a face");
    const auto count = to_number<std::uint32_t>(take_word(rest_));
    if (!count) fail("the number of corners of a face");
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < *count; ++i) {
      const auto corner = to_number<std::uint32_t>(take_word(rest_));
      if (!corner || *corner >= raw.mesh.vertices.size()) {
        fail("indices of vertices");
      }
      corners.push_back(*corner);
    }
    raw.add_face(corners);
  }

  TextLines lines_;
  std::size_t most_lines_;
  std::string_view rest_;  // of the line
  bool is_homogeneous_ = false;
};

}  // namespace

RawMesh parse_off(std::string_view bytes) { return OffReader(bytes).read(); }

}  // namespace lamina::csg
