#include "base/source.h"

#include <algorithm>
#include <utility>

namespace lamina {

namespace {

// The place behind the next `end`, or the end of the text.
std::size_t skip_past(std::string_view text, std::string_view end,
                      std::size_t begin) {
  const std::size_t found = text.find(end, begin);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

// The place behind the string that begins at `opening`.
std::size_t skip_string(std::string_view text, std::size_t opening) {
  std::size_t i = opening + 1;
  while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
  return i + 1;
}

}  // namespace

Source::Source(std::string path, std::string text, bool is_implied)
    : path_(std::move(path)), text_(std::move(text)), is_implied_(is_implied) {
  line_starts_.push_back(0);
  std::size_t end = text_.find('\n');
  while (end != std::string::npos) {
    line_starts_.push_back(static_cast<std::uint32_t>(end + 1));
    end = text_.find('\n', end + 1);
  }
  has_returns_ = text_.find('\r') != std::string::npos;
  const std::size_t mark = text_.rfind(kEndOfFile);
  if (mark != std::string::npos && mark + kEndOfFile.size() < text_.size()) {
    definitions_begin_ = mark + kEndOfFile.size();
  }
  const std::string_view file = std::string_view(text_).substr(0, mark);
  file_end_ = static_cast<std::uint32_t>(file.find_last_not_of(" \t\r\n") + 1);
}

std::uint32_t Source::openscad_line(std::uint32_t offset) const {
  std::uint32_t line = line_column(offset).line;
  if (!has_returns_) return line;
  const std::string_view before = std::string_view(text_).substr(0, offset);
  std::size_t i = 0;
  while (i < before.size()) {
    const std::string_view pair = before.substr(i, 2);
    if (before[i] == '\r') ++line;
    if (pair == "//") {
      i = skip_past(before, "\n", i);
    } else if (pair == "/*") {
      i = skip_past(before, "*/", i + 2);
    } else if (before[i] == '"') {
      i = skip_string(before, i);
    } else {
      ++i;
    }
  }
  return line;
}

LineColumn Source::line_column(std::uint32_t offset) const {
  const auto size = static_cast<std::uint32_t>(text_.size());
  const std::uint32_t place = std::min(offset, size);
  const auto next =
      std::upper_bound(line_starts_.begin(), line_starts_.end(), place);
  const auto line = static_cast<std::uint32_t>(next - line_starts_.begin());
  return {line, place - line_starts_[line - 1] + 1};
}

std::string_view Source::line_text(std::uint32_t line) const {
  if (line == 0 || line > line_starts_.size()) return {};
  const std::size_t begin = line_starts_[line - 1];
  const std::size_t end =
      line < line_starts_.size() ? line_starts_[line] : text_.size();
  std::string_view text(text_.data() + begin, end - begin);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) {
    text.remove_suffix(1);
  }
  return text;
}

std::string_view SourceRange::text() const {
  if (source == nullptr) return {};
  return std::string_view(source->text()).substr(begin, end - begin);
}

const Source& SourceStore::add(std::string path, std::string text,
                               bool is_implied) {
  return sources_.emplace_back(std::move(path), std::move(text), is_implied);
}

}  // namespace lamina
