// Every .scad file below this folder is a test: its comments say what it must
// give.
//
//   // expect: ECHO: 6               a line of the `.echo` file
//   // expect csg: cube(size = …     a line of the `.csg` file
//   // expect terminal: a.scad:3:1…  a line on the terminal, carets included
//
// All lines of the `.echo` file must be there, and no others; the lines of the
// other two are compared where the file has any. `\t` stands for a tab.

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/csg/eval/evaluate_text.h"

namespace lamina::csg {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = LAMINA_LANGUAGE_FOLDER;

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
    const fs::path& path = entry.path();
    const bool is_part = path.stem().string().ends_with("_part");
    if (path.extension() == ".scad" && !is_part) {
      names.push_back(path.lexically_relative(kFolder).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

// The lines behind `mark` at the beginning of a line.
std::string expected(const std::string& text, const std::string& mark) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(mark)) continue;
    line = line.substr(std::min(mark.size() + 1, line.size()));
    for (std::size_t at = line.find("\\t"); at != std::string::npos;
         at = line.find("\\t")) {
      line.replace(at, 2, 1, '\t');
    }
    result += line;
    result += '\n';
  }
  return result;
}

class Language : public testing::TestWithParam<std::string> {};

TEST_P(Language, GivesWhatItsCommentsExpect) {
  const std::string path = fs::path(kFolder) / GetParam();
  const std::string text = read_text(path);
  const Evaluated result = evaluate_file(path);
  EXPECT_EQ(result.echo, expected(text, "// expect:"));
  const std::string csg = expected(text, "// expect csg:");
  if (!csg.empty()) {
    EXPECT_EQ(result.csg, csg + '\n');
  }
  const std::string terminal = expected(text, "// expect terminal:");
  if (!terminal.empty()) {
    std::string shown = result.terminal;
    for (std::size_t at = shown.find(kFolder); at != std::string::npos;
         at = shown.find(kFolder)) {
      shown.erase(at, kFolder.size() + 1);
    }
    EXPECT_EQ(shown, terminal);
  }
}

std::string case_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param.substr(0, info.param.size() - 5);
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, Language, testing::ValuesIn(cases()),
                         case_name);

}  // namespace
}  // namespace lamina::csg
