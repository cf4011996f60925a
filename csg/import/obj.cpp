#include <string>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {
namespace {

class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : lines_(bytes) {}

  RawMesh read() {
    while (next_line()) {
      const std::string_view keyword = take_word(rest_);
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f") {
        read_face();
      }
    }
    return std::move(raw_);
  }

 private:
  [[noreturn]] void fail(std::string_view expected) const {
    throw FormatError(
        fmt::format("OBJ line {}, expected {}", lines_.number(), expected));
  }

  // A backslash at the end joins a line with the next one.
  bool next_line() {
    auto line = lines_.next();
    if (!line) return false;
    rest_ = *line;
    if (!rest_.ends_with('\\')) return true;
    joined_.clear();
    while (line && line->ends_with('\\')) {
      joined_ += line->substr(0, line->size() - 1);
      joined_ += ' ';
      line = lines_.next();
    }
    if (line) joined_ += *line;
    rest_ = joined_;
    return true;
  }

  void read_vertex() {
    Vec3 vertex(0);
    for (int i = 0; i < 3; ++i) {
      const auto number = to_number<double>(take_word(rest_));
      if (!number) fail("coordinates of a vertex");
      vertex[i] = *number;
    }
    raw_.mesh.vertices.push_back(vertex);
  }

  void read_face() {
    corners_.clear();
    for (;;) {
      // vertex, vertex/texture, vertex//normal, vertex/texture/normal
      const std::string_view word = take_word(rest_);
      if (word.empty() || word.front() == '#') break;
      corners_.push_back(to_corner(word.substr(0, word.find('/'))));
    }
    raw_.add_face(corners_);
  }

  std::uint32_t to_corner(std::string_view word) const {
    const auto count = static_cast<std::int64_t>(raw_.mesh.vertices.size());
    const auto number = to_number<std::int64_t>(word);
    if (!number || *number == 0 || *number > count || *number < -count) {
      fail("indices of vertices");
    }
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1
                                                  : count + *number);
  }

  TextLines lines_;
  std::string_view rest_;  // of the line
  std::string joined_;
  std::vector<std::uint32_t> corners_;
  RawMesh raw_;
};

}  // namespace

RawMesh parse_obj(std::string_view bytes) { return ObjReader(bytes).read(); }

}  // namespace lamina::csg
