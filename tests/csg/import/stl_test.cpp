#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/letter_case.h"
#include "csg/import/mesh_file.h"
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
    const char attribute[2] = {};
    append(attribute, sizeof attribute);
  }
  return bytes;
}

const std::vector<Vec3> kFacetCorners = {{0, 0, 0}, {1.5, 0, 0}, {0, 2, -0.25}};
const std::vector<std::vector<float>> kFacets = {
    {0, 0, 0, 1.5, 0, 0, 0, 2, -0.25}, {1, 2, 3, 4, 5, 6, 7, 8, 9}};

TEST(ParseStl, ReadsTheVerticesOfText) {
  const RawMesh raw = parse_stl(kText);
  EXPECT_EQ(raw.mesh.vertices, kFacetCorners);
  EXPECT_EQ(raw.mesh.triangles.size(), 1U);
}

TEST(ParseStl, ReadsTextInCapitalsAndWithOtherEndsOfLines) {
  std::string capitals = kText;
  for (char& c : capitals) c = upper_case(c);
  std::string returns = kText;
  std::ranges::replace(returns, '\n', '\r');
  std::string both;
  for (const char c : kText) both += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text : {capitals, returns, both}) {
    EXPECT_EQ(parse_stl(text).mesh.vertices, kFacetCorners) << text;
  }
}

TEST(ParseStl, ReadsBinary) {
  const RawMesh raw = parse_stl(binary("some program", kFacets));
  ASSERT_EQ(raw.mesh.triangles.size(), 2U);
  ASSERT_EQ(raw.mesh.vertices.size(), 6U);
  EXPECT_EQ(raw.mesh.vertices[2], kFacetCorners[2]);
  EXPECT_EQ(raw.mesh.vertices[5], Vec3(7, 8, 9));
}

using Corners = std::array<Vec3, 3>;

std::vector<Corners> sorted_corners(const Mesh& mesh) {
  const auto is_before = [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::vector<Corners> result;
  for (const auto& t : mesh.triangles) {
    result.push_back(
        {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  std::sort(result.begin(), result.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        is_before);
  });
  return result;
}

// A bumpy sheet of 2 · side² facets, row by row.
std::vector<std::vector<float>> sheet(int side) {
  const auto append = [](std::vector<float>& facet, int x, int y) {
    const auto u = static_cast<float>(x);
    const auto v = static_cast<float>(y);
    facet.insert(facet.end(), {u, v, std::sin(u) * std::cos(v)});
  };
  std::vector<std::vector<float>> facets;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (const int other : {0, 1}) {
        facets.emplace_back();
        append(facets.back(), x, y);
        append(facets.back(), x + 1, y + other);
        append(facets.back(), x + other, y + 1);
      }
    }
  }
  return facets;
}

TEST(ParseStl, ReadsTheSameFacetsInWhateverOrder) {
  constexpr int kSide = 150;
  std::vector<std::vector<float>> facets = sheet(kSide);
  const Mesh ordered = parse_stl(binary("x", facets)).mesh;
  std::shuffle(facets.begin(), facets.end(), std::mt19937(1));
  const Mesh shuffled = parse_stl(binary("x", facets)).mesh;
  EXPECT_EQ(ordered.vertices.size(), (kSide + 1) * (kSide + 1));
  EXPECT_EQ(shuffled.vertices.size(), ordered.vertices.size());
  EXPECT_EQ(sorted_corners(shuffled), sorted_corners(ordered));
}

TEST(ParseStl, ReadsFacetsThatAreAllTheSame) {
  const std::vector<std::vector<float>> facets(20'000, kFacets[0]);
  const Mesh mesh = parse_stl(binary("x", facets)).mesh;
  EXPECT_EQ(mesh.vertices, kFacetCorners);
  EXPECT_EQ(mesh.triangles.size(), facets.size());
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
