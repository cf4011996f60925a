// docs/languages.md lists every file that treats the two languages differently,
// with the number of lines that do.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace {

namespace fs = std::filesystem;

using lamina::testing::kRoot;

// What only gives a variable its first value.
const std::regex kInitialiser(R"([^=!]= Language::k2021[;,)])");

std::vector<std::string> lines_of(const fs::path& path) {
  std::vector<std::string> lines;
  std::ifstream text(path);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

bool asks_for_language(const std::string& line) {
  const std::string code = line.substr(0, line.find("//"));
  for (const char* use : {"Language::k20", "is_2021()", "quoted_name("}) {
    if (code.find(use) != std::string::npos) {
      return !std::regex_search(code, kInitialiser);
    }
  }
  return false;
}

// Files of the product, each with the number of its lines that ask for the
// language.
std::map<std::string, int> uses_in_code() {
  const std::set<std::string> others = {"bench", "build", "examples", "tests"};
  std::map<std::string, int> uses;
  for (auto entry = fs::recursive_directory_iterator(kRoot);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename();
    if (name.front() == '.' || (entry.depth() == 0 && others.contains(name))) {
      entry.disable_recursion_pending();
      continue;
    }
    const fs::path extension = entry->path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    const auto lines = lines_of(entry->path());
    const auto count =
        std::count_if(lines.begin(), lines.end(), asks_for_language);
    if (count > 0)
      uses[fs::relative(entry->path(), kRoot)] = static_cast<int>(count);
  }
  return uses;
}

std::map<std::string, int> uses_on_page() {
  std::map<std::string, int> uses;
  const std::regex row(R"(^\| `([\w/.]+)` \| (\d+) \| .+ \|$)");
  for (const std::string& line : lines_of(kRoot / "docs" / "languages.md")) {
    std::smatch match;
    if (std::regex_match(line, match, row)) {
      uses[match[1].str()] = std::stoi(match[2].str());
    }
  }
  return uses;
}

TEST(Languages, AreListed) {
  const auto code = uses_in_code();
  const auto page = uses_on_page();
  for (const auto& [file, count] : code) {
    EXPECT_TRUE(page.contains(file) && page.at(file) == count)
        << "docs/languages.md should have this row:\n"
        << fmt::format("| `{}` | {} | … |", file, count);
  }
  for (const auto& [file, count] : page) {
    EXPECT_TRUE(code.contains(file))
        << "docs/languages.md has " << file << ", which does not ask";
  }
}

}  // namespace
