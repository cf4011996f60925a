// dxf_dim() and dxf_cross() give OpenSCAD's values and warnings on drawings
// that are right, unusual or broken.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/conformance/both_programs.h"

namespace lamina::conformance {
namespace {

// DXF groups, written "code value|code value".
std::string groups(std::string written) {
  std::string text;
  for (const char c : written) text += c == ' ' || c == '|' ? '\n' : c;
  return text + '\n';
}

std::string drawing(const std::string& entities) {
  return groups("0 SECTION|2 ENTITIES|" + entities + "|0 ENDSEC|0 EOF");
}

const std::string kLine = "0 LINE|8 0|10 0|20 10|11 10|21 0";

class Drawings : public BothPrograms {
 protected:
  // Asks all drawings for all that they may hold. openscad reads a drawing once
  // for equal questions: a run asks each drawing one.
  void expect_same_measures(const std::vector<std::string>& drawings) {
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      folder_.write(fmt::format("{}.dxf", i), drawings[i]);
    }
    for (const char* const asked :
         {"dxf_cross(file = f)",
          R"(dxf_cross(file = f, layer = "0", origin = [1, 2], scale = 3))",
          R"(dxf_cross(file = f, origin = "x", other = 1, scale = "a"))",
          "dxf_dim(file = f)",
          R"(dxf_dim(file = f, name = "n", layer = "d", scale = 2))"}) {
      folder_.write("a.scad",
                    fmt::format("for (i = [0 : {}]) let (f = str(i, \".dxf\")) "
                                "echo(f, {});",
                                drawings.size() - 1, asked));
      SCOPED_TRACE(asked);
      expect_same_echo({}, "a.scad");
    }
  }
};

TEST_F(Drawings, CrossesOfAllEntities) {
  std::vector<std::string> drawings;
  for (const char* const entity :
       {"0 LINE|8 0|10 0|20 0|11 10|21 10",
        "0 LINE|8 other|10 0|20 0|11 10|21 10",
        "0 LWPOLYLINE|8 0|90 2|70 0|10 0|20 0|10 10|20 10",
        "0 LWPOLYLINE|8 0|90 2|70 1|10 0|20 0|10 10|20 10",
        "0 CIRCLE|8 0|10 50|20 0|40 5", "0 ARC|8 0|10 0|20 0|40 5|50 0|51 10",
        "0 ARC|8 0|10 50|20 0|40 5|50 0|51 90",
        "0 ELLIPSE|8 0|10 0|20 0|11 5|21 0|40 0.5|41 0|42 0.1",
        "0 SPLINE|8 0|10 1|20 1", "0 TEXT|8 0|1 words"}) {
    drawings.push_back(drawing(entity + ("|" + kLine)));
  }
  drawings.push_back(
      groups("0 SECTION|2 BLOCKS|0 BLOCK|2 b|0 LINE|10 0|20 0|11 4|21 4|"
             "0 ENDBLK|0 ENDSEC|0 SECTION|2 ENTITIES|"
             "0 INSERT|8 0|2 b|10 1|20 0|41 2|42 1|50 30|" +
             kLine + "|0 ENDSEC|0 EOF"));
  expect_same_measures(drawings);
}

TEST_F(Drawings, DimensionsOfAllTypes) {
  std::vector<std::string> drawings;
  for (const int type : {0, 1, 2, 3, 4, 5, 6, 7, 32, 64, 70, 134}) {
    drawings.push_back(drawing(
        fmt::format("0 DIMENSION|8 d|1 n|70 {}|10 1|20 2|11 3|21 4|12 5|22 6|"
                    "13 1.5|23 2.5|14 7.25|24 9|15 4|25 1|16 0|26 3|50 30",
                    type)));
  }
  expect_same_measures(drawings);
}

TEST_F(Drawings, BrokenFiles) {
  const std::string whole = drawing(kLine + "|" + kLine);
  std::vector<std::string> drawings;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    drawings.push_back(whole.substr(0, size));
  }
  drawings.push_back(groups("0 SECTION|xx yy|2 ENTITIES|" + kLine));
  drawings.push_back(drawing("0 LINE|8 0|10 abc|20 0|11 1x|21 10|" + kLine));
  drawings.push_back(drawing("0 LINE|8 0|10 1|20 0|" + kLine));
  drawings.push_back(
      drawing("0 LWPOLYLINE|8 0|90 2x|70 z|10 0|20 0|10 1|20 1|" + kLine +
              "|0 ELLIPSE|8 0|10 0|20 0|11 e|21 0|40 0.5|41 0|42 0.1|"
              "0 DIMENSION|8 d|1 n|70 1.5|13 0|23 0|14 3|24 4"));
  expect_same_measures(drawings);
}

}  // namespace
}  // namespace lamina::conformance
