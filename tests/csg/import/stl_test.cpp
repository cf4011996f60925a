#include "csg/import/stl.h"

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

const std::string kText =
    "solid corner\n"
    "  facet normal 0 0 1\n"
    "    outer loop\n"
    "      vertex 0 0 0\n"
    "      vertex 1.5 0 0\r\n"
    "      vertex 0 +2e0 -0.25\n"
    "    endloop\n"
    "  endfacet\n"
    "endsolid corner\n";

std::string binary(const std::string& header,
                   const std::vector<std::vector<float>>& facets) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(facets.size());
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  append(&count, sizeof count);
  for (const std::vector<float>& corners : facets) {
    const float normal[3] = {0, 0, 1};
    append(normal, sizeof normal);
    append(corners.data(), 9 * sizeof(float));
    append("\0", 2);
  }
  return bytes;
}

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1.5, 0, 0}, {0, 2, -0.25}};
const std::vector<std::vector<float>> kFacets = {
    {0, 0, 0, 1.5, 0, 0, 0, 2, -0.25}, {1, 2, 3, 4, 5, 6, 7, 8, 9}};

TEST(ParseStl, ReadsTheVerticesOfText) {
  const RawMesh raw = parse_stl(kText);
  EXPECT_EQ(raw.mesh.vertices, kCorners);
  EXPECT_EQ(raw.mesh.triangles.size(), 1U);
}

TEST(ParseStl, ReadsBinary) {
  const RawMesh raw = parse_stl(binary("some program", kFacets));
  ASSERT_EQ(raw.mesh.triangles.size(), 2U);
  ASSERT_EQ(raw.mesh.vertices.size(), 6U);
  EXPECT_EQ(raw.mesh.vertices[2], kCorners[2]);
  EXPECT_EQ(raw.mesh.vertices[5], Vec3(7, 8, 9));
}

TEST(ParseStl, TrustsTheSizeMoreThanTheWordSolid) {
  EXPECT_EQ(parse_stl(binary("solid x\n", kFacets)).mesh.triangles.size(), 2U);
}

TEST(ParseStl, SaysWhatAFileOfNeitherKindLacks) {
  const std::string_view no_header =
      "STL file is neither text nor a whole header";
  EXPECT_EQ(fault_of([] { parse_stl(""); }), no_header);
  EXPECT_EQ(fault_of([] { parse_stl("garbage"); }), no_header);
  std::string cut_off = binary("x", kFacets);
  cut_off.pop_back();
  EXPECT_EQ(fault_of([&] { parse_stl(cut_off); }),
            "STL file of 2 facets should be 184 bytes long, not 183,");
}

TEST(ParseStl, NamesTheLineOfAVertexWithoutNumbers) {
  std::string text = kText;
  text.replace(text.find("1.5"), 3, "1,5");
  EXPECT_EQ(fault_of([&] { parse_stl(text); }),
            "STL line 5, can't parse vertex line 'vertex 1,5 0 0'");
}

TEST(ParseStl, NamesTheLineOfAFourthVertex) {
  std::string text = kText;
  text.insert(text.find("    endloop"), "vertex 7 7 7\n");
  EXPECT_EQ(fault_of([&] { parse_stl(text); }),
            "STL line 7, extra vertex line 'vertex 7 7 7'");
}

TEST(ParseStl, SurvivesWhateverBefallsAFile) {
  const auto parse = [](std::string_view bytes) {
    expect_whole(parse_stl(bytes));
  };
  expect_no_harm(kText, parse);
  expect_no_harm(binary("solid", kFacets), parse);
}

}  // namespace
}  // namespace lamina::csg
