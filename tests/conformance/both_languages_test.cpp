// Languages 2021 and 2026 on small designs, beside OpenSCAD 2021.01 and
// 2025.07.18.
//
// Each design of languages/differ means different things in the two: lamina
// must make of it in each what the program of that language makes. Those of
// languages/newer mean something in newer OpenSCAD only: lamina must make that
// of them in both languages.
//
// Sections of the solid at seven generic heights, below and above it must agree
// (geometry_judge.h), and so must all lines of echo(). A design may begin with
// its volumes, such as "// 2026: 3 mm³": they must be those of OpenSCAD's
// meshes.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/conformance/geometry_judge.h"
#include "tests/oracle/openscad.h"
#include "tests/support/openscad_cache.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

using support::OpenScad;

const fs::path kDesigns =
    fs::path(LAMINA_SOURCES) / "tests/conformance/languages";

constexpr std::size_t kHeights = 7;
constexpr double kOutside = 0.1;        // mm
constexpr double kVolumeDigits = 2e-3;  // relative: the designs state three

struct Question {
  std::string design;    // "differ/cylinder"
  std::string language;  // of lamina
  OpenScad judge = OpenScad::k2026;
};

std::ostream& operator<<(std::ostream& out, const Question& question) {
  return out << question.design << " in language " << question.language;
}

std::vector<Question> questions() {
  std::vector<Question> all;
  for (const std::string folder : {"differ", "newer"}) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(kDesigns / folder)) {
      if (entry.path().extension() != ".scad") continue;
      names.insert(folder + "/" + entry.path().stem().string());
    }
    for (const std::string& name : names) {
      all.push_back({name, "2021",
                     folder == "newer" ? OpenScad::k2026 : OpenScad::k2021});
      all.push_back({name, "2026", OpenScad::k2026});
    }
  }
  return all;
}

support::OpenScadResult ask(const fs::path& design, OpenScad judge) {
  std::vector<std::string> options = {"--export-format", "binstl"};
  if (judge == OpenScad::k2026) {
    options.insert(options.end(), {"--backend=Manifold", "--enable=roof"});
  }
  support::OpenScadResult result =
      support::ask_openscad(design, "stl", options, judge);
  const bool is_empty =
      result.words.find("object is empty") != std::string::npos;
  if (result.output.empty() && !is_empty) {
    throw std::runtime_error("openscad fails: " + result.words);
  }
  return result;
}

std::string echoes(const std::string& words) {
  std::string found;
  std::istringstream lines(words);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("ECHO: ")) found += line + '\n';
  }
  return found;
}

std::string echoes_of_lamina(const Design& design) {
  const support::TemporaryFolder folder;
  const std::string output = folder.file("out.echo");
  support::run_process({LAMINA_PROGRAM, design.path, "--language",
                        design.language, "-q", "-o", output});
  return echoes(support::read_file(output));
}

// What the design says of its volume in that language [mm³]; NaN: nothing.
double stated_volume(const Design& design) {
  const std::string text = support::read_file(design.path.string());
  const std::regex stated("// " + design.language + ": ([0-9.]+) mm³");
  std::smatch found;
  return std::regex_search(text, found, stated) ? std::stod(found[1])
                                                : std::nan("");
}

// Heights through the mesh, and one below and one above it.
std::vector<double> heights_through(const csg::Mesh& mesh) {
  const auto [low, high] = std::minmax_element(
      mesh.vertices.begin(), mesh.vertices.end(),
      [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  std::vector<double> heights = generic_heights(mesh, kHeights);
  heights.insert(heights.begin(), low->z - kOutside);
  heights.push_back(high->z + kOutside);
  return heights;
}

void expect_equal_solids(const Design& design, const Reference& reference) {
  const double volume = csg::signed_volume(reference.mesh);
  const double stated = stated_volume(design);
  if (!std::isnan(stated)) {
    EXPECT_NEAR(volume, stated, kVolumeDigits * stated) << "of openscad's mesh";
  }
  const Judgement judgement =
      judge_solid(reference, design, heights_through(reference.mesh));
  EXPECT_EQ(judgement.verdict, "equal") << judgement.complaint;
}

class LanguageDesigns : public testing::TestWithParam<Question> {};

TEST_P(LanguageDesigns, AreReadAsOpenScadReadsThem) {
  const auto& [name, language, judge] = GetParam();
  const Design design = {kDesigns / (name + ".scad"), language};
  const support::OpenScadResult theirs = ask(design.path, judge);
  EXPECT_EQ(echoes_of_lamina(design), echoes(theirs.words));
  if (theirs.output.empty()) {
    EXPECT_NE(echoes(theirs.words), "") << "the design shows nothing";
  } else {
    expect_equal_solids(
        design, {ReferenceKind::kSolid, oracle::read_binary_stl(theirs.output),
                 theirs.words});
  }
}

std::string case_name(const testing::TestParamInfo<Question>& info) {
  const auto& [name, language, judge] = info.param;
  std::string words = name + "_" + language;
  for (char& c : words) {
    if (c == '/') c = '_';
  }
  return words;
}

INSTANTIATE_TEST_SUITE_P(Small, LanguageDesigns, testing::ValuesIn(questions()),
                         case_name);

}  // namespace
}  // namespace lamina::conformance
