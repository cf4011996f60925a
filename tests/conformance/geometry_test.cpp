// Geometry of the designs that come with OpenSCAD: its tests and examples.
//
// openscad and lamina render each. Sections of openscad's mesh at seven generic
// heights, or the outline of a 2D design, judge lamina's layers
// (geometry_judge.h). Every case leaves a row for the table that
// geometry_table_test checks; docs/conformance.md lists the exceptions.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/conformance/geometry_judge.h"
#include "tests/conformance/geometry_rows.h"
#include "tests/conformance/page.h"
#include "tests/conformance/reference.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

const fs::path kData = LAMINA_OPENSCAD_DATA;

constexpr std::size_t kHeights = 7;

Judgement judge_design(const std::string& name) {
  const Design design = {kData / name, "2021"};
  const Reference reference = render_reference(kData, design.path);
  switch (reference.kind) {
    case ReferenceKind::kSolid:
      return judge_solid(reference, design,
                         generic_heights(reference.mesh, kHeights));
    case ReferenceKind::kOutline:
      return judge_outline(reference, design);
    case ReferenceKind::kEmpty:
      return judge_empty(reference, design);
  }
  throw std::logic_error("no such kind");
}

class Geometry : public ::testing::TestWithParam<std::string> {};

TEST_P(Geometry, EqualsWhatOpenScadRenders) {
  const std::string& name = GetParam();
  const Judgement outcome = judge_design(name);
  write_row(LAMINA_GEOMETRY_ROWS, {name, outcome.verdict, outcome.complaint});
  if (is_exception(name)) {
    EXPECT_EQ(outcome.verdict, "differs")
        << "docs/conformance.md calls " << name << " an exception";
  } else {
    EXPECT_NE(outcome.verdict, "differs") << outcome.complaint;
  }
}

std::string case_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param.substr(0, info.param.size() - 5);
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Designs, Geometry,
                         ::testing::ValuesIn(geometry_designs(kData)),
                         case_name);

}  // namespace
}  // namespace lamina::conformance
