#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "csg/import/mesh_file.h"
#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

const std::string kPlainOffPyramid =
    "OFF\n5 5 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 3\n"
    "4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

// The same with much that does not matter: comments, an element between,
// colours, a list of a vertex, the axes in another order.
const std::string kPlyPyramid =
    "ply\r\n"
    "format ascii 1.0\r\n"
    "comment made by hand\n"
    "obj_info as well\n"
    "element vertex 5\n"
    "property uchar red\n"
    "property float z\n"
    "property list uchar short weights\n"
    "property float32 y\n"
    "property double x\n"
    "element range_grid 2\n"
    "property list uint8 int32 vertex_indices\n"
    "element face 5\n"
    "property uchar flags\n"
    "property list uchar int vertex_index\n"
    "end_header\n"
    "255 0 0 0 0\n"
    "255 0 1 7 0 2\n"
    "255 0 3 7 8 9 2 2\n"
    "255 0 0 2 0\n"
    "255 3e0 0 1 1\n"
    "1 0\n0\n"
    "1 4 3 2 1 0\n1 3 0 1 4\n1 3 1 2 4\n1 3 2 3 4\n1 3 3 0 4\n";

// Numbers as bytes of either order.
class Bytes {
 public:
  explicit Bytes(bool is_big_endian) : is_big_endian_(is_big_endian) {}

  template <typename Number>
  Bytes& add(std::initializer_list<Number> numbers) {
    for (const Number number : numbers) {
      std::string bytes(sizeof number, '\0');
      std::memcpy(bytes.data(), &number, sizeof number);
      if (is_big_endian_) std::reverse(bytes.begin(), bytes.end());
      all_ += bytes;
    }
    return *this;
  }
  const std::string& all() const { return all_; }

 private:
  bool is_big_endian_;
  std::string all_;
};

std::string binary_pyramid(bool is_big_endian) {
  const std::string order = is_big_endian ? "big" : "little";
  Bytes body(is_big_endian);
  const double corners[5][3] = {
      {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  for (const auto& p : corners) {
    body.add<float>({static_cast<float>(p[0])});
    body.add<double>({p[1]});
    body.add<std::int8_t>({-1});
    body.add<std::uint16_t>({static_cast<std::uint16_t>(p[2])});
  }
  body.add<std::uint16_t>({4}).add<std::uint32_t>({3, 2, 1, 0});
  for (std::uint32_t i = 0; i < 4; ++i) {
    body.add<std::uint16_t>({3}).add<std::uint32_t>({i, (i + 1) % 4, 4});
  }
  return "ply\nformat binary_" + order +
         "_endian 1.0\nelement vertex 5\nproperty float x\nproperty double y\n"
         "property char quality\nproperty ushort z\nelement face 5\n"
         "property list ushort uint vertex_indices\nend_header\n" +
         body.all();
}

void expect_pyramid(const RawMesh& raw) {
  const RawMesh off = parse_off(kPlainOffPyramid);
  EXPECT_EQ(raw.mesh, off.mesh);
  EXPECT_EQ(raw.polygons, off.polygons);
}

TEST(ParsePly, ReadsInEveryEncodingWhatOffReads) {
  expect_pyramid(parse_ply(kPlyPyramid));
  expect_pyramid(parse_ply(binary_pyramid(false)));
  expect_pyramid(parse_ply(binary_pyramid(true)));
}

TEST(ParsePly, ReadsStripsOfTriangles) {
  const RawMesh raw = parse_ply(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
      "property float y\nproperty float z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 2 1 3\n");
  EXPECT_EQ(raw.mesh.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{
                {0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {2, 1, 3}}));
}

// A header with `lines` in it, of a text file.
std::string with_header(const std::string& lines, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + lines + "end_header\n" + body;
}

const std::string kVertex =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFace =
    "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n";

TEST(ParsePly, SaysWhatWasExpectedWhere) {
  const auto fault = [](const std::string& text) {
    return fault_of([&] { parse_ply(text); });
  };
  EXPECT_EQ(fault("garbage"), "PLY line 1, expected ply");
  EXPECT_EQ(fault("ply\nformat binary 1.0\n"),
            "PLY line 2, expected ascii, binary_little_endian or "
            "binary_big_endian");
  EXPECT_EQ(fault("ply\nelement vertex -1\n"),
            "PLY line 2, expected the number of elements");
  EXPECT_EQ(fault("ply\nend_header\n"),
            "PLY line 2, expected format before end_header");
  EXPECT_EQ(fault("ply\nelement vertex 1\nproperty list float int x\n"),
            "PLY line 3, expected whole numbers as lengths of lists");
  EXPECT_EQ(fault(with_header(kFace, "")),
            "PLY header, expected an element 'vertex'");
  EXPECT_EQ(fault(with_header(kVertex + kVertex, kPoints)),
            "PLY header, expected one element 'vertex'");
  EXPECT_EQ(fault(with_header("element vertex 1\nproperty int x\n", "1")),
            "PLY header, expected x, y and z of a vertex, once each");
  EXPECT_EQ(fault(with_header("element vertex 100\n" + kFace, "3 0 1 2")),
            "PLY header, expected x, y and z of a vertex, once each");
  EXPECT_EQ(fault(with_header(kVertex + "element face 100\n", kPoints)),
            "PLY header, expected a list 'vertex_indices' of whole numbers in "
            "element 'face'");
  EXPECT_EQ(fault(with_header(kVertex + kFace, "0 0 0\n1 0 a\n")),
            "PLY vertex 2 of 3, expected 'z'");
  EXPECT_EQ(fault(with_header(kVertex + kFace, kPoints + "3 0 1 3\n")),
            "PLY face 1 of 1, expected indices of vertices");
  EXPECT_EQ(fault(with_header(kVertex + kFace, kPoints + "3 0 1 -1\n")),
            "PLY face 1 of 1, expected indices of vertices");
  EXPECT_EQ(fault(with_header(kVertex + kFace, kPoints + "-3 0 1 2\n")),
            "PLY face 1 of 1, expected the length of 'vertex_indices'");
  EXPECT_EQ(fault(with_header(kVertex, kPoints)),
            "PLY without faces: points alone bound no solid,");
}

TEST(ParsePly, CountsThatTheFileCannotHoldTakeNeitherMemoryNorTime) {
  const auto fault = [](const std::string& text) {
    return fault_of([&] { parse_ply(text); });
  };
  EXPECT_EQ(fault(with_header("element vertex 4000000000\nproperty float x\n"
                              "property float y\nproperty float z\n",
                              "0 0 0")),
            "PLY vertex 2 of 4000000000, expected 'x'");
  EXPECT_EQ(fault(with_header(kVertex + kFace, kPoints + "255 0 0")),
            "PLY face 1 of 1, expected 'vertex_indices'");
  EXPECT_EQ(fault(with_header("element nothing 4294967295\n" + kVertex + kFace,
                              kPoints + "3 0 1 2")),
            "");
}

TEST(ParsePly, SurvivesWhateverBefallsAFile) {
  for (const std::string& file :
       {kPlyPyramid, binary_pyramid(false), binary_pyramid(true)}) {
    expect_no_harm(
        file, [](std::string_view bytes) { expect_whole(parse_ply(bytes)); });
  }
}

}  // namespace
}  // namespace lamina::csg
