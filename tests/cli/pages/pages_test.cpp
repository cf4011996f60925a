// The manual and the completions: that they say what the program knows, and
// that --help has an entry for each option and for nothing else.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/pages/command_pages.h"
#include "cli/pages/help_text.h"
#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using Names = std::set<std::string>;

TEST(ReadHelp, TakesEntriesApart) {
  const std::vector<HelpBlock> blocks = read_help(
      "Usage: x\n\nOutput:\n"
      "  -o FILE        the output\n"
      "                   .slc  layers\n"
      "  -q, --quiet    say nothing\n"
      "  --heights Z1,Z2,... sections\n"
      "  --long-one MM\n"
      "                 text below\n"
      "  -p FILE -P SET values\n");
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].lines, std::vector<std::string>{"Usage: x"});
  EXPECT_EQ(blocks[1].heading, "Output");
  const std::vector<HelpEntry>& entries = blocks[1].entries;
  ASSERT_EQ(entries.size(), 5U);
  EXPECT_EQ(entries[0].text,
            (std::vector<std::string>{"the output", "  .slc  layers"}));
  ASSERT_EQ(entries[1].options.size(), 2U);
  EXPECT_EQ(entries[1].options[1].name, "--quiet");
  EXPECT_EQ(entries[1].options[1].value, "");
  EXPECT_EQ(entries[2].options[0].value, "Z1,Z2,...");
  EXPECT_EQ(entries[2].text, std::vector<std::string>{"sections"});
  EXPECT_EQ(entries[3].text, std::vector<std::string>{"text below"});
  ASSERT_EQ(entries[4].options.size(), 2U);
  EXPECT_EQ(entries[4].options[1].name, "-P");
  EXPECT_EQ(entries[4].options[1].value, "SET");
}

Names names_in_help(const CommandPage& page) {
  Names names;
  for (const HelpBlock& block : page.help) {
    for (const HelpEntry& entry : block.entries) {
      for (const NamedValue& option : entry.options) names.insert(option.name);
    }
  }
  return names;
}

Names names_of(const CommandPage& page) {
  Names names;
  for (const OptionPage& option : page.options) {
    names.insert(option.names.begin(), option.names.end());
  }
  return names;
}

TEST(Help, HasAnEntryForEveryOption) {
  for (const CommandPage& page : command_pages()) {
    for (const OptionPage& option : page.options) {
      EXPECT_NE(option.text, "")
          << "lamina " << page.name << ": " << option.names.back();
    }
  }
}

TEST(Help, HasNoEntryForWhatIsNoOption) {
  for (const CommandPage& page : command_pages()) {
    const Names known = names_of(page);
    for (const std::string& name : names_in_help(page)) {
      EXPECT_EQ(known.count(name), 1U)
          << "lamina " << page.name << ": " << name;
    }
  }
}

TEST(Help, NamesEveryCommandInItsUsage) {
  for (const CommandPage& page : command_pages()) {
    EXPECT_NE(page.text, "") << "lamina " << page.name;
  }
}

// All that looks like an option in a text: dashes at the beginning of a word.
Names options_in(const std::string& text) {
  Names names;
  for (std::size_t at = text.find('-'); at != std::string::npos;
       at = text.find('-', at + 1)) {
    const bool is_inside =
        at > 0 &&
        (std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0 ||
         text[at - 1] == '-');
    if (is_inside) continue;
    std::size_t end = at;
    while (end < text.size() &&
           (text[end] == '-' ||
            std::isalnum(static_cast<unsigned char>(text[end])) != 0)) {
      ++end;
    }
    names.insert(text.substr(at, end - at));
  }
  return names;
}

std::string without(std::string text, const std::string& part) {
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part)) {
    text.erase(at, part.size());
  }
  return text;
}

Names options_of_the_program() {
  Names names;
  for (const CommandPage& page : command_pages()) names.merge(names_of(page));
  return names;
}

std::string page(const std::string& name) {
  return support::read_file(std::string(LAMINA_PAGES) + "/" + name);
}

TEST(ManPage, NamesEveryOption) {
  const Names shown = options_in(
      without(without(without(page("lamina.1"), "\\fB"), "\\fR"), "\\"));
  for (const std::string& name : options_of_the_program()) {
    EXPECT_EQ(shown.count(name), 1U) << name;
  }
}

TEST(Completions, NameEveryOption) {
  for (const char* shell : {"lamina.bash", "_lamina"}) {
    const Names shown = options_in(page(shell));
    for (const std::string& name : options_of_the_program()) {
      EXPECT_EQ(shown.count(name), 1U) << shell << ": " << name;
    }
  }
  const std::string fish = page("lamina.fish");
  for (const std::string& name : options_of_the_program()) {
    const bool is_long = name.starts_with("--");
    const std::string flag =
        is_long ? " -l " + name.substr(2) + " " : " -s " + name.substr(1) + " ";
    EXPECT_NE(fish.find(flag), std::string::npos) << name;
  }
}

// --help of the program itself, not of the sources it is made from.
TEST(ManPage, SaysWhatHelpSays) {
  const support::TemporaryFolder folder;
  const std::string help = run(folder, {"--help"}).output;
  const Names shown = options_in(
      without(without(without(page("lamina.1"), "\\fB"), "\\fR"), "\\"));
  for (const HelpBlock& block : read_help(help)) {
    for (const HelpEntry& entry : block.entries) {
      for (const NamedValue& option : entry.options) {
        EXPECT_EQ(shown.count(option.name), 1U) << option.name;
      }
    }
  }
}

}  // namespace
}  // namespace lamina::cli
