#include "cli/options/output_pattern.h"

#include <algorithm>
#include <filesystem>

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

// Calls take_text with what stands outside braces, take_word with what stands
// inside. A brace that is not closed is text.
template <typename TakeText, typename TakeWord>
void walk(std::string_view pattern, const TakeText& take_text,
          const TakeWord& take_word) {
  while (true) {
    const std::size_t begin = pattern.find('{');
    const std::size_t end = pattern.find('}', std::min(begin, pattern.size()));
    if (end == std::string_view::npos) break;
    take_text(pattern.substr(0, begin));
    take_word(std::string(pattern.substr(begin + 1, end - begin - 1)));
    pattern.remove_prefix(end + 1);
  }
  take_text(pattern);
}

}  // namespace

std::vector<std::string> words_of_pattern(std::string_view pattern) {
  std::vector<std::string> words;
  walk(
      pattern, [](std::string_view) {},
      [&](std::string word) { words.push_back(std::move(word)); });
  return words;
}

std::string fill_pattern(
    std::string_view pattern,
    const std::function<std::string(const std::string& word)>& value_of) {
  std::string text;
  walk(
      pattern, [&](std::string_view piece) { text += piece; },
      [&](const std::string& word) { text += value_of(word); });
  return text;
}

std::string fault_of_name(std::string_view text) {
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

void make_folder_of(const std::string& output, const FileAccess& access) {
  const fs::path folder = fs::path(output).parent_path();
  if (!folder.empty()) access.make_folders(folder);
}

std::string normal_path(const std::string& path) {
  return fs::path(path).lexically_normal().string();
}

std::string stem(const std::string& path) { return fs::path(path).stem(); }

}  // namespace lamina::cli
