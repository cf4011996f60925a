#include "cli/options/output_pattern.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/diagnostic.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

// Why `text` cannot be a part of the name of a file; empty if it can.
std::string fault_of_part(std::string_view text) {
  if (text.empty()) return "is empty";
  if (text.find('/') != std::string_view::npos) return "has a '/' in it";
  if (text == "." || text.find("..") != std::string_view::npos) {
    return "has '..' in it";
  }
  if (std::any_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
      })) {
    return "has a line break or another control character in it";
  }
  return "";
}

}  // namespace

std::string fill_pattern(
    std::string_view pattern,
    const std::function<std::string(const std::string& word)>& value_of) {
  std::string text;
  while (true) {
    const std::size_t begin = pattern.find('{');
    const std::size_t end = pattern.find('}', std::min(begin, pattern.size()));
    if (end == std::string_view::npos) break;
    text += pattern.substr(0, begin);
    text += value_of(std::string(pattern.substr(begin + 1, end - begin - 1)));
    pattern.remove_prefix(end + 1);
  }
  return text += pattern;
}

std::vector<std::string> words_of_pattern(std::string_view pattern) {
  std::vector<std::string> words;
  fill_pattern(pattern, [&](const std::string& word) {
    words.push_back(word);
    return word;
  });
  return words;
}

std::string require_part_of_name(const std::string& text) {
  const std::string fault = fault_of_part(text);
  if (fault.empty()) return text;
  throw FileError(
      fmt::format("'{}' {} and can be no part of a file's name", text, fault));
}

void make_folder_of(const std::string& output, const FileAccess& access) {
  const fs::path folder = fs::path(output).parent_path();
  if (!folder.empty()) access.make_folders(folder);
}

std::string stem(const std::string& path) { return fs::path(path).stem(); }

}  // namespace lamina::cli
