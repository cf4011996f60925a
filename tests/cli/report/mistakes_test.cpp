// What lamina says of mistakes: a table (mistakes.txt) of what was typed, the
// exit status and every word of the answer. No word may name a wrong place, or
// a cure that is none.

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/base/file/zip_writer.h"
#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

struct Mistake {
  std::string title;   // behind "## "
  std::string words;   // of the command line, behind "$ lamina "
  std::string design;  // a.scad, each line behind "| "
  int status = 0;      // behind "= "
  std::string answer;  // all other lines
};

std::vector<Mistake> read_table() {
  std::ifstream file(LAMINA_MISTAKES);
  std::vector<Mistake> table;
  for (std::string line; std::getline(file, line);) {
    const auto rest = [&](std::size_t size) { return line.substr(size); };
    if (line.starts_with("## ")) {
      table.emplace_back().title = rest(3);
    } else if (table.empty()) {
      continue;
    } else if (line.starts_with("$ lamina ")) {
      table.back().words = rest(9);
    } else if (line.starts_with("|")) {
      table.back().design += rest(line.size() > 1 ? 2 : 1) + '\n';
    } else if (line.starts_with("= ")) {
      table.back().status = std::stoi(rest(2));
    } else if (!line.empty()) {
      table.back().answer += line + '\n';
    }
  }
  return table;
}

// Files that the mistakes name.
void write_files(const TemporaryFolder& folder) {
  folder.write("ok.scad", "size = 5;\ncube(size);\n");
  folder.write("good.scad", "cube(4);\n");
  folder.write("junk.slc", "no layers at all");
  const std::string page = "<!DOCTYPE html>\n<html><body>Sign in</body></html>";
  for (const char* name : {"page.stl", "page.3mf", "page.sl1"}) {
    folder.write(name, page);
  }
  folder.write("cut.stl",
               "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n"
               "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nfacet nor");
  const std::string zip = csg::make_zip({{"3D/3dmodel.model", "<model/>"}});
  folder.write("cut.3mf", zip.substr(0, zip.size() / 2));
  folder.write("letters.scad",
               "linear_extrude(1) text(\"a\xe6\x84\x9b\","
               " font = \"Liberation Sans\");\n");
  run(folder, {"ok.scad", "-q", "-o", "whole.slc"});
  folder.write("cut.slc",
               support::read_file(folder.file("whole.slc")).substr(0, 2000));
  run(folder, {"ok.scad", "-q", "-o", "b.slices.3mf"});
  std::filesystem::rename(folder.file("b.slices.3mf"), folder.file("b.3mf"));
  folder.write("slices.scad", "import(\"b.3mf\");\n");
}

// Without what every run says, and what depends on the machine.
std::string answer_of(const support::ProcessResult& result,
                      const TemporaryFolder& folder) {
  static const std::regex usual(
      "(.* layers?, .* kB, .*|print: .*|  lamina check .*|"
      ".* of processor time .*|Run 'lamina --help' for the options\\.)");
  static const std::regex fonts(
      "(font \"[^\"]*\" can(, but not the rest)?|no font here can)");
  std::istringstream lines(result.output + result.errors);
  std::string answer;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || std::regex_match(line, usual)) continue;
    const std::size_t at = line.find(folder.path());
    if (at != std::string::npos) {
      line.replace(at, folder.path().size(), "FOLDER");
    }
    answer += std::regex_replace(line, fonts, "FONT") + '\n';
  }
  return answer;
}

TEST(Mistakes, AreAnsweredWithTheRightPlaceAndCure) {
  const std::vector<Mistake> table = read_table();
  EXPECT_GE(table.size(), 120U);
  const TemporaryFolder folder;
  write_files(folder);
  for (const Mistake& mistake : table) {
    SCOPED_TRACE(mistake.title + ": lamina " + mistake.words);
    folder.write("a.scad", mistake.design);
    const auto result = support::run_process(
        {"bash", "-c", std::string(LAMINA_PROGRAM) + " " + mistake.words},
        folder.path());
    EXPECT_EQ(result.status, mistake.status);
    EXPECT_EQ(answer_of(result, folder), mistake.answer);
  }
}

}  // namespace
}  // namespace lamina::cli
