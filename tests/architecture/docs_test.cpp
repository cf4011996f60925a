// The pages that explain lamina name files, and files move. Each name of a file
// or folder on a page must be one of the tree.

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace {

namespace fs = std::filesystem;

using lamina::testing::kRoot;

struct Name {
  std::string page;
  int line = 0;
  std::string words;
};

// Files and folders of the tree, without what builds and git keep in it.
std::vector<fs::path> all_files() {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(kRoot);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename();
    if (name == "build" || name.front() == '.') {
      entry.disable_recursion_pending();
    } else {
      files.push_back(entry->path());
    }
  }
  return files;
}

std::vector<fs::path> all_pages() {
  std::vector<fs::path> pages;
  for (const fs::path& file : all_files()) {
    if (file.extension() == ".md") pages.push_back(file);
  }
  return pages;
}

// Without decisions, which speak of their day and may name what has gone.
std::vector<fs::path> pages_of_today() {
  std::vector<fs::path> pages = all_pages();
  std::erase_if(pages, [](const fs::path& page) {
    return page.parent_path().filename() == "decisions";
  });
  return pages;
}

// What `pattern` finds in the pages; its first group is the name.
std::vector<Name> names_on(const std::vector<fs::path>& pages,
                           const std::regex& pattern) {
  std::vector<Name> names;
  for (const fs::path& file : pages) {
    std::ifstream text(file);
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
      for (auto match = std::sregex_iterator(line.begin(), line.end(), pattern);
           match != std::sregex_iterator(); ++match) {
        names.push_back({fs::relative(file, kRoot), number, (*match)[1]});
      }
    }
  }
  EXPECT_FALSE(names.empty()) << "no page holds such a name";
  return names;
}

TEST(Pages, LinkToFilesOfTheTree) {
  for (const Name& link :
       names_on(all_pages(), std::regex(R"(\]\(([^)#:]+)[)#])"))) {
    EXPECT_TRUE(fs::exists((kRoot / link.page).parent_path() / link.words))
        << link.page << ":" << link.line << " links to " << link.words;
  }
}

// In backquotes: `csg/lower`, `scripts/test -L oracle`, and
// `bench/whole_program` for the program that a source of that name makes.
TEST(Pages, NameOnlyPathsOfTheTree) {
  const std::regex path(
      R"(`((?:api|base|bench|cli|cmake|compiler|csg|docs|examples|grammar|ldni|)"
      R"(parser|plane|scripts|slicer|tests)/[\w./-]*\w))");
  for (const Name& name : names_on(pages_of_today(), path)) {
    EXPECT_TRUE(fs::exists(kRoot / name.words) ||
                fs::exists(kRoot / (name.words + ".cpp")))
        << name.page << ":" << name.line << " names " << name.words;
  }
}

// `simplify.h`, where the text around it tells the folder.
TEST(Pages, NameOnlySourcesOfTheTree) {
  std::set<std::string> sources;
  for (const fs::path& file : all_files()) sources.insert(file.filename());
  for (const Name& name :
       names_on(pages_of_today(), std::regex(R"(`(\w+\.(?:h|cpp))`)"))) {
    EXPECT_TRUE(sources.contains(name.words))
        << name.page << ":" << name.line << " names " << name.words;
  }
}

// `Job`, `kTieDistance`, `run_pipeline`, `architecture_test`: the pages for
// those who change the code name only what is in it.
TEST(Pages, NameOnlyWordsOfTheCode) {
  std::set<std::string> words;
  const std::regex word(R"(\w+)");
  for (const fs::path& file : all_files()) {
    const std::string extension = file.extension();
    if (extension != ".h" && extension != ".cpp" &&
        file.filename() != "CMakeLists.txt") {
      continue;
    }
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) {
      words.insert(std::sregex_token_iterator(line.begin(), line.end(), word),
                   std::sregex_token_iterator());
    }
  }
  const fs::path docs = kRoot / "docs";
  for (const Name& name :
       names_on({docs / "design.md", docs / "glossary.md", docs / "recipes.md",
                 docs / "wrong-contour.md"},
                std::regex(R"(`(?:\w+::)?(\w*[A-Z_]\w*)`)"))) {
    EXPECT_TRUE(words.contains(name.words))
        << name.page << ":" << name.line << " names " << name.words;
  }
}

}  // namespace
