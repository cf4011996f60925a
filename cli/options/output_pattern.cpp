#include "cli/options/output_pattern.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "cli/options/option_values.h"

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

// What stands behind the ":/" of a word.
constexpr std::string_view kDivision = ":/";

// The value of what stands between braces.
std::string value_of_braces(
    std::string_view braces,
    const std::function<std::string(const std::string& word)>& value_of) {
  const std::size_t mark = braces.find(kDivision);
  std::string value = value_of(std::string(braces.substr(0, mark)));
  if (mark == std::string_view::npos) return value;
  const auto divisor = whole_number(braces.substr(mark + kDivision.size()));
  if (!divisor || *divisor == 0) {
    throw FileError(fmt::format(
        "'{{{}}}': a number from 1 was expected behind ':/'", braces));
  }
  const auto number = whole_number(value);
  if (!number) {
    throw FileError(
        fmt::format("'{{{}}}' divides whole numbers, not '{}'", braces, value));
  }
  return fmt::format("{}", *number / *divisor);
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
    text +=
        value_of_braces(pattern.substr(begin + 1, end - begin - 1), value_of);
    pattern.remove_prefix(end + 1);
  }
  text += pattern;
  if (text == "-") {
    throw FileError("'-' is standard output and can be no file's name");
  }
  return text;
}

std::vector<std::string> words_of_pattern(std::string_view pattern) {
  std::vector<std::string> words;
  fill_pattern(pattern, [&](const std::string& word) {
    words.push_back(word);
    return "0";
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
