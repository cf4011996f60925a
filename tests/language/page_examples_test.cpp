// The programs that docs/languages.md shows give what it says.

#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/csg/eval/evaluate_text.h"
#include "tests/support/temporary_folder.h"

namespace lamina::csg {
namespace {

// The lines of a section that are set in from the margin.
std::string code_of_section(const std::string& heading) {
  std::istringstream lines(read_text(LAMINA_LANGUAGES));
  std::string code;
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) is_inside = line == heading;
    if (is_inside && line.starts_with("    ")) code += line.substr(4) + '\n';
  }
  return code;
}

// What stands behind each `echo(…);  //`, as lines of the `.echo` file.
std::string echoes_in_comments(const std::string& code) {
  std::istringstream lines(code);
  std::string echoes;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("echo(")) continue;
    echoes += "ECHO: " + line.substr(line.rfind("// ") + 3) + '\n';
  }
  return echoes;
}

TEST(LanguagesPage, WhatIsNewerThan2021DoesWhatItSays) {
  const std::string code = code_of_section("## Newer features");
  const std::string echoes = echoes_in_comments(code);
  ASSERT_FALSE(echoes.empty());
  const support::TemporaryFolder folder;
  folder.write("ring.json", R"({"stones": [{"d": 2}, {"d": 1.25}]})");
  EXPECT_EQ(evaluate_file(folder.write("usage.scad", code)).echo, echoes);
}

}  // namespace
}  // namespace lamina::csg
