#pragma once
// Source texts and places in them.
//
// Every AST node, CSG node and leaf carries the range of text that made it, so
// that each later stage can say where a fault comes from. A range is two
// offsets and a pointer: 16 bytes, cheap enough to stand everywhere.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace lamina {

// Stands between the text of a file and the definitions of `-D` behind it.
inline constexpr std::string_view kEndOfFile = "\n\x03\n";

// Line and column, both counted from 1; the column counts bytes.
struct LineColumn {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

// The text of a file, or that of `-D`.
class Source {
 public:
  // path        as messages show it and as relative file names are resolved
  //             against
  // is_implied  whether nobody wrote the text: it imports the file at `path`
  Source(std::string path, std::string text, bool is_implied = false);

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  bool is_implied() const { return is_implied_; }

  // O(log lines). An offset past the end is the place behind the last byte.
  LineColumn line_column(std::uint32_t offset) const;

  // The line as OpenSCAD 2021.01 counts it in warnings: a carriage return
  // outside strings and comments begins a line of its own. Where there are
  // none, and in the messages of its parser, it is the line above.
  std::uint32_t openscad_line(std::uint32_t offset) const;

  // Where the definitions of `-D` begin; npos where there are none.
  std::size_t definitions_begin() const { return definitions_begin_; }

  // Behind the last letter of the file, which stands before them.
  std::uint32_t file_end() const { return file_end_; }

  // Line `line` (from 1) without its line break.
  std::string_view line_text(std::uint32_t line) const;

 private:
  std::string path_;
  std::string text_;
  std::size_t definitions_begin_ = std::string::npos;
  std::uint32_t file_end_ = 0;
  std::vector<std::uint32_t> line_starts_;
  bool has_returns_ = false;
  bool is_implied_ = false;
};

// Bytes [begin, end) of one source; no source means "no place".
struct SourceRange {
  const Source* source = nullptr;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  bool is_known() const { return source != nullptr; }
  // Whether a user can look it up: it stands in a text that somebody wrote.
  bool is_written() const { return is_known() && !source->is_implied(); }
  // Whether it stands in the definitions of `-D`.
  bool is_defined_by_option() const {
    return is_known() && begin >= source->definitions_begin();
  }
  // Its first line as OpenSCAD counts it; 0 without a place.
  std::uint32_t openscad_line() const {
    return is_known() ? source->openscad_line(begin) : 0;
  }
  std::string_view text() const;
};

// Owns sources; their addresses stay valid as long as the store lives.
class SourceStore {
 public:
  const Source& add(std::string path, std::string text,
                    bool is_implied = false);

 private:
  std::deque<Source> sources_;
};

}  // namespace lamina
