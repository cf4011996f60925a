// Reading as such. The oracle (tests/oracle/cad_test.cpp) has parts of all
// kinds.

#include "csg/cad/cad_reader.h"

#include <algorithm>
#include <array>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "base/file/format_error.h"
#include "tests/support/mesh_winding.h"
#include "tests/support/temporary_folder.h"

namespace lamina::cad {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

std::string seed(const std::string& name) {
  return bytes_of(std::string(LAMINA_SEEDS) + "/" + name);
}

std::string replaced(std::string text, const std::string& from,
                     const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

double volume_of(const csg::Mesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    volume += glm::dot(mesh.vertices[t[0]],
                       glm::cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) /
              6;
  }
  return volume;
}

bool is_closed(const csg::Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++sides[{t[k], t[(k + 1) % 3]}];
      --sides[{t[(k + 1) % 3], t[k]}];
    }
  }
  for (const auto& [side, count] : sides) {
    if (count != 0) return false;
  }
  return true;
}

// The seeds are cylinders of radius 5 and height 12.
constexpr double kVolume = std::numbers::pi * 25 * 12;

class CadReader : public ::testing::Test {
 protected:
  Part read(const std::string& bytes, Format format,
            const Fineness& fineness = {}, unsigned most_seconds = 60) {
    Reader reader({LAMINA_MODULES}, diagnostics_, most_seconds);
    return reader.read(bytes, format, fineness);
  }

  std::string failure(const std::string& bytes, Format format,
                      unsigned most_seconds = 60,
                      const Fineness& fineness = {}) {
    try {
      read(bytes, format, fineness, most_seconds);
    } catch (const FormatError& fault) {
      return fault.what();
    }
    return "";
  }

  // The first warning; empty if there is none.
  std::string warning(const std::string& bytes, Format format) {
    const Part part = read(bytes, format);
    return part.warnings.empty() ? std::string() : part.warnings[0];
  }

  Diagnostics diagnostics_;
};

void expect_cylinder(const Part& part, double chordal_error) {
  ASSERT_EQ(part.bodies.size(), 1U);
  const csg::Mesh& mesh = part.bodies[0].mesh;
  EXPECT_TRUE(part.warnings.empty());
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_LT(volume_of(mesh), kVolume);
  EXPECT_GT(volume_of(mesh),
            kVolume - chordal_error * 2 * std::numbers::pi * 5 * 12);
}

TEST_F(CadReader, ReadsAllFormats) {
  const std::pair<const char*, Format> kFiles[] = {
      {"step/cylinder", Format::kStep},
      {"iges/cylinder", Format::kIges},
      {"brep/cylinder", Format::kBrep},
      {"brep/binary", Format::kBrep}};
  for (const auto& [name, format] : kFiles) {
    SCOPED_TRACE(name);
    for (const double error : {0.5, 0.01, 0.0002}) {
      expect_cylinder(read(seed(name), format, {.chordal_error = error}),
                      error);
    }
  }
}

TEST_F(CadReader, ReadsSeveralFilesOneAfterAnother) {
  Reader reader({LAMINA_MODULES}, diagnostics_);
  for (int i = 0; i < 2; ++i) {
    expect_cylinder(reader.read(seed("iges/cylinder"), Format::kIges, {}),
                    0.01);
    EXPECT_THROW(reader.read("", Format::kStep, {}), FormatError);
    expect_cylinder(reader.read(seed("step/cylinder"), Format::kStep, {}),
                    0.01);
  }
}

TEST_F(CadReader, KeepsAnAngleBesideALargeChordalError) {
  const auto triangles = [&](double angle) {
    return read(seed("step/cylinder"), Format::kStep,
                {.chordal_error = 1, .angle = angle})
        .bodies[0]
        .mesh.triangles.size();
  };
  EXPECT_GT(triangles(0.05), 3 * triangles(0.35));
}

TEST_F(CadReader, NamesSolids) {
  std::string step = seed("step/cylinder");
  const std::string name = "Open CASCADE STEP translator 7.6";
  for (std::size_t at = step.find(name); at != std::string::npos;
       at = step.find(name, at)) {
    step.replace(at, name.size(), "bracket");
  }
  const Part part = read(step, Format::kStep);
  ASSERT_EQ(part.bodies.size(), 1U);
  EXPECT_EQ(part.bodies[0].name.substr(0, 7), "bracket");
}

// No smaller triangle is nearer to a surface that is not at its face's edges.
TEST_F(CadReader, SplitsNoTrianglesInVain) {
  const std::string off =
      replaced(seed("step/cylinder"), "'',#32,5.)", "'',#32,5.05)");
  const Part part = read(off, Format::kStep);
  ASSERT_EQ(part.bodies.size(), 1U);
  EXPECT_LT(part.bodies[0].mesh.triangles.size(), 30000U);
  ASSERT_EQ(part.warnings.size(), 1U);
  EXPECT_NE(part.warnings[0].find("deviates by 0.05"), std::string::npos)
      << part.warnings[0];
}

// One face of three is missing: what is left is a shell, and open.
TEST_F(CadReader, ReportsWhatIsOpen) {
  std::string step = seed("step/cylinder");
  const std::size_t end = step.find(')', step.find("CLOSED_SHELL(''"));
  const std::size_t comma = step.rfind(',', end);
  step.erase(comma, end - comma);
  const Part part = read(step, Format::kStep);
  ASSERT_EQ(part.bodies.size(), 1U);
  EXPECT_FALSE(is_closed(part.bodies[0].mesh));
  EXPECT_EQ(part.warnings,
            (std::vector<std::string>{"OpenCASCADE can't use 1 of 3 faces",
                                      "1 of 1 shells are open"}));
}

TEST_F(CadReader, SaysWhatIsNoSuchFile) {
  EXPECT_EQ(failure("solid", Format::kStep),
            "STEP that is no exchange structure of ISO 10303-21");
  EXPECT_EQ(failure("solid", Format::kIges),
            "IGES whose first line has no S in column 73");
  EXPECT_EQ(failure("solid", Format::kBrep),
            "BREP that does not begin with 'CASCADE Topology'");
}

TEST_F(CadReader, SurvivesWhatEndsOpenCascade) {
  EXPECT_EQ(
      failure(bytes_of(LAMINA_CRASHES "/step/segmentation"), Format::kStep),
      "OpenCASCADE fails on this STEP");
  EXPECT_EQ(
      failure(bytes_of(LAMINA_CRASHES "/brep/segmentation"), Format::kBrep),
      "OpenCASCADE fails on this BREP");
  EXPECT_EQ(failure(bytes_of(LAMINA_CRASHES "/brep/endless"), Format::kBrep),
            "BREP that ends too early, or has words for numbers");
}

TEST_F(CadReader, EndsWhatTakesTooLong) {
  EXPECT_EQ(
      failure(seed("step/cylinder"), Format::kStep, 1, {.chordal_error = 1e-7}),
      "OpenCASCADE takes more than 1 s for this STEP");
}

TEST_F(CadReader, RefusesWhatIsFinerThanOpenCascade) {
  EXPECT_EQ(failure(seed("step/cylinder"), Format::kStep, 60,
                    {.chordal_error = 1e-8}),
            "OpenCASCADE keeps no chordal error of 1e-08 mm, only 1e-07 mm and "
            "more: the part is scaled too much");
}

// In time, too: a file that is cut off kept OpenCASCADE busy for ever.
TEST_F(CadReader, SaysThatABrepIsCutOff) {
  for (const char* name : {"brep/cylinder", "brep/binary"}) {
    const std::string whole = seed(name);
    constexpr std::size_t kParts = 30;
    for (std::size_t i = 1; i < kParts; ++i) {
      const std::string words =
          failure(whole.substr(0, whole.size() * i / kParts), Format::kBrep);
      EXPECT_NE(words, "") << name << i;
      EXPECT_EQ(words.find("OpenCASCADE takes"), std::string::npos)
          << name << i << words;
    }
  }
}

// A cylinder, and `second` for a further solid beside it.
std::string step_of_two(const std::string& second) {
  return replaced(
      replaced(seed("step/cylinder"), "(#11,#15)", "(#11,#15,#900)"),
      "#15 =", "#900 = " + second + ";\n#15 =");
}

TEST_F(CadReader, CountsWhatOpenCascadeLeavesOut) {
  const std::pair<std::string, std::string> kSteps[] = {
      {step_of_two("MANIFOLD_SOLID_BREP('',#16)"), ""},
      {step_of_two("MANIFOLD_SOLID_BREP('',#999)"),
       "1 of 2 solids, 1 of 111 entities of shapes or units"},
      {step_of_two("MANIFOLD_SOLID_BRAP('',#16)"),
       "1 of 111 entities of shapes or units"},
      {step_of_two(
           "MANIFOLD_SOLID_BREP('',#901);\n#901 = CLOSED_SHELL('',(#902));"
           "\n#902 = ADVANCED_FACE('',(#18),#999,.T.)"),
       "1 of 2 solids, 1 of 4 faces, 1 of 113 entities of shapes or units"},
      {replaced(seed("step/cylinder"), "CYLINDRICAL_SURFACE('',#32,5.)",
                "CYLINDRICAL_SURFACE('',#32,-5.)"),
       "1 of 3 faces, 1 of 110 entities of shapes or units"},
      {replaced(seed("step/cylinder"), "SI_UNIT(.MILLI.,.METRE.)",
                "SI_UNIT(.MILLE.,.METRE.)"),
       "1 of 110 entities of shapes or units"}};
  for (const auto& [bytes, words] : kSteps) {
    EXPECT_EQ(warning(bytes, Format::kStep),
              words.empty() ? words : "OpenCASCADE can't use " + words);
  }
  std::string iges = seed("iges/cylinder");
  for (int i = 0; i < 2; ++i)
    iges = replaced(iges, "\n     144 ", "\n     145 ");
  EXPECT_EQ(warning(iges, Format::kIges),
            "OpenCASCADE can't use 1 of 26 entities of shapes or units");
}

// --- Shells ------------------------------------------------------------------

// A box with whole numbers for corners, as a closed shell.
struct Box {
  std::array<int, 3> low;
  std::array<int, 3> high;
  bool looks_inward = false;

  bool has(Vec3 p) const {
    return low[0] < p.x && p.x < high[0] && low[1] < p.y && p.y < high[1] &&
           low[2] < p.z && p.z < high[2];
  }
};

// The lines of a shell, from #first on. A corner is a number of three bits, one
// for each axis; an edge joins two that differ in one bit.
std::string step_of(const Box& box, int first) {
  std::string lines;
  int next = first + 1;
  const auto add = [&](const std::string& entity) {
    lines += fmt::format("#{} = {};\n", next, entity);
    return next++;
  };
  const auto add_direction = [&](std::size_t axis, double length) {
    std::array<double, 3> d{};
    d[axis] = length;
    return add(
        fmt::format("DIRECTION('',({:.1f},{:.1f},{:.1f}))", d[0], d[1], d[2]));
  };
  std::array<int, 8> points{};
  std::array<int, 8> vertices{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::array<int, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = ((corner >> k & 1) != 0 ? box.high : box.low)[k];
    }
    points[corner] =
        add(fmt::format("CARTESIAN_POINT('',({}.,{}.,{}.))", p[0], p[1], p[2]));
    vertices[corner] = add(fmt::format("VERTEX_POINT('',#{})", points[corner]));
  }
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (std::size_t from = 0; from < 8; ++from) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t to = from | std::size_t{1} << axis;
      if (to == from) continue;
      const int along =
          add(fmt::format("VECTOR('',#{},1.)", add_direction(axis, 1)));
      const int line =
          add(fmt::format("LINE('',#{},#{})", points[from], along));
      edges[{from, to}] = add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)",
                                          vertices[from], vertices[to], line));
    }
  }
  std::string faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = std::size_t{1} << (axis + 1) % 3;
    const std::size_t v = std::size_t{1} << (axis + 2) % 3;
    for (const bool is_high : {false, true}) {
      const std::size_t at = is_high ? std::size_t{1} << axis : 0;
      const bool looks_up = is_high != box.looks_inward;
      std::array<std::size_t, 4> corners = {at, at + u, at + u + v, at + v};
      if (!looks_up) std::ranges::reverse(corners);
      std::vector<int> sides;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t a = corners[k];
        const std::size_t b = corners[(k + 1) % 4];
        sides.push_back(add(fmt::format("ORIENTED_EDGE('',*,*,#{},.{}.)",
                                        edges[{std::min(a, b), std::max(a, b)}],
                                        a < b ? 'T' : 'F')));
      }
      const int z = add_direction(axis, looks_up ? 1 : -1);
      const int x = add_direction((axis + 1) % 3, 1);
      const int place = add(fmt::format("AXIS2_PLACEMENT_3D('',#{},#{},#{})",
                                        points[corners[0]], z, x));
      const int plane = add(fmt::format("PLANE('',#{})", place));
      const int loop =
          add(fmt::format("EDGE_LOOP('',(#{}))", fmt::join(sides, ",#")));
      const int bound = add(fmt::format("FACE_OUTER_BOUND('',#{},.T.)", loop));
      faces += fmt::format(
          "{}#{}", faces.empty() ? "" : ",",
          add(fmt::format("ADVANCED_FACE('',(#{}),#{},.T.)", bound, plane)));
    }
  }
  return fmt::format("#{} = CLOSED_SHELL('',({}));\n", first, faces) + lines;
}

std::string step_of_shells(const std::vector<Box>& boxes) {
  std::string shells;
  std::string lines;
  int first = 1000;
  for (const Box& box : boxes) {
    shells += fmt::format("{}#{}", shells.empty() ? "" : ",", first);
    lines += step_of(box, first);
    first += 1000;
  }
  std::string step = replaced(seed("step/cylinder"), "(#11,#15)", "(#11,#900)");
  const std::size_t cylinder = step.find("#15 =");
  return step.replace(
      cylinder, step.find("#113 =") - cylinder,
      fmt::format("#900 = SHELL_BASED_SURFACE_MODEL('',({}));\n{}", shells,
                  lines));
}

TEST_F(CadReader, MakesThePartThatIsAskedFor) {
  const std::string step =
      step_of_shells({{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {4, 1, 1}}});
  Reader reader({LAMINA_MODULES}, diagnostics_);
  EXPECT_EQ(reader.read(step, Format::kStep, {}).bodies.size(), 2U);
  const Part part = reader.read(step, Format::kStep, {}, "2");
  ASSERT_EQ(part.bodies.size(), 1U);
  EXPECT_DOUBLE_EQ(volume_of(part.bodies[0].mesh), 2);
  EXPECT_THROW(reader.read(step, Format::kStep, {}, "3"), FormatError);
}

// What bodies fill of a cube of 12 mm: so many mm³.
int filled_by(const std::vector<Body>& bodies) {
  constexpr int kSize = 12;
  int count = 0;
  for (int i = 0; i < kSize * kSize * kSize; ++i) {
    const Vec3 p(i % kSize + 0.5, i / kSize % kSize + 0.5,
                 i / kSize / kSize + 0.5);
    const bool is_filled =
        std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
          return std::lround(support::winding_number(body.mesh, p)) != 0;
        });
    if (is_filled) ++count;
  }
  return count;
}

int volume_of(const Box& box) {
  return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]) *
         (box.high[2] - box.low[2]);
}

int volume_of_both(const Box& a, const Box& b) {
  int volume = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    volume *= std::max(
        0, std::min(a.high[k], b.high[k]) - std::max(a.low[k], b.low[k]));
  }
  return volume;
}

Box common(const Box& a, const Box& b) {
  Box both = a;
  for (std::size_t k = 0; k < 3; ++k) {
    both.low[k] = std::max(a.low[k], b.low[k]);
    both.high[k] = std::max(both.low[k], std::min(a.high[k], b.high[k]));
  }
  return both;
}

class Shells : public CadReader {
 protected:
  int number(int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random_);
  }
  bool either() { return number(0, 1) == 1; }

  // In any order: what is a void must not depend on it.
  void expect_volume(std::vector<Box> boxes, int volume) {
    std::shuffle(boxes.begin(), boxes.end(), random_);
    const std::string bytes = step_of_shells(boxes);
    const Part part = read(bytes, Format::kStep);
    EXPECT_EQ(part.warnings, std::vector<std::string>());
    EXPECT_EQ(filled_by(part.bodies), volume) << bytes;
  }

  std::mt19937 random_{1};
};

// Some corners are in another box, or none. Edges may lie in each other, but no
// box is within another, of which it might be a void.
TEST_F(Shells, ThatCrossAreUnited) {
  for (int i = 0; i < 40; ++i) {
    const int end = either() ? 7 : 12;
    const Box a{{0, 0, 0}, {6, 6, 6}, either()};
    const Box b{
        {number(0, 4), number(0, 5), number(1, 5)}, {end, 8, 8}, either()};
    const Box c{
        {number(0, 1), number(3, 4), number(0, 1)}, {5, 11, 10}, either()};
    const int two = volume_of(a) + volume_of(b) - volume_of_both(a, b);
    expect_volume({a, b}, two);
    expect_volume({a, b, c}, two + volume_of(c) - volume_of_both(a, c) -
                                 volume_of_both(b, c) +
                                 volume_of_both(common(a, b), c));
  }
}

TEST_F(Shells, ThatPierceAreUnited) {
  for (int i = 0; i < 20; ++i) {
    const int from = number(3, 5);
    const Box plate{{1, 1, 4}, {11, 11, 7}, either()};
    const Box bar{{from, from, 0}, {8, 9, number(9, 12)}, either()};
    expect_volume({plate, bar}, volume_of(plate) + volume_of(bar) -
                                    volume_of_both(plate, bar));
  }
}

// A void looks the other way than what is around it, whichever that is.
TEST_F(Shells, InEachOtherAreVoidsByTurns) {
  for (int i = 0; i < 20; ++i) {
    const bool inward = either();
    const Box a{{0, 0, 0}, {12, 12, 12}, inward};
    const Box b{{1, 1, number(1, 2)}, {11, 10, 11}, !inward};
    const Box c{{3, number(2, 4), 3}, {number(8, 9), 9, 9}, inward};
    const Box d{{5, 6, number(4, 6)}, {7, 7, 8}, !inward};
    expect_volume({a, b}, volume_of(a) - volume_of(b));
    expect_volume({a, b, c}, volume_of(a) - volume_of(b) + volume_of(c));
    expect_volume({a, b, c, d},
                  volume_of(a) - volume_of(b) + volume_of(c) - volume_of(d));
    // Two in one that look its way, beside a void.
    expect_volume({a, c}, volume_of(a));
  }
}

TEST_F(Shells, ThatTouchFromInsideAreVoids) {
  for (int i = 0; i < 20; ++i) {
    const bool inward = either();
    const Box a{{0, 0, 0}, {10, 10, 10}, inward};
    const Box inside{{2, number(1, 4), 0}, {8, 7, number(3, 9)}, !inward};
    const Box beside{{2, number(1, 4), 10}, {8, 7, number(11, 12)}, either()};
    expect_volume({a, inside}, volume_of(a) - volume_of(inside));
    expect_volume({a, beside}, volume_of(a) + volume_of(beside));
  }
}

// Lines of a STEP more.
std::string with_lines(const std::string& step, const std::string& lines) {
  return replaced(step, "ENDSEC;\nEND-ISO", lines + "ENDSEC;\nEND-ISO");
}

// The cylinder as a part of an assembly that has it twice, once 30 mm aside.
std::string step_of_assembly() {
  return with_lines(seed("step/cylinder"), R"(
#200 = SHAPE_DEFINITION_REPRESENTATION(#201,#204);
#201 = PRODUCT_DEFINITION_SHAPE('','',#202);
#202 = PRODUCT_DEFINITION('design','',#203,#9);
#203 = PRODUCT_DEFINITION_FORMATION('','',#7);
#204 = SHAPE_REPRESENTATION('',(#11,#205),#113);
#205 = AXIS2_PLACEMENT_3D('',#206,#13,#14);
#206 = CARTESIAN_POINT('',(30.,0.,0.));
#210 = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#211,#213);
#211 = ( REPRESENTATION_RELATIONSHIP('','',#10,#204)
REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#212)
SHAPE_REPRESENTATION_RELATIONSHIP() );
#212 = ITEM_DEFINED_TRANSFORMATION('','',#11,#11);
#213 = PRODUCT_DEFINITION_SHAPE('','',#214);
#214 = NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#202,#5,$);
#220 = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#221,#223);
#221 = ( REPRESENTATION_RELATIONSHIP('','',#10,#204)
REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#222)
SHAPE_REPRESENTATION_RELATIONSHIP() );
#222 = ITEM_DEFINED_TRANSFORMATION('','',#11,#205);
#223 = PRODUCT_DEFINITION_SHAPE('','',#224);
#224 = NEXT_ASSEMBLY_USAGE_OCCURRENCE('2','','',#202,#5,$);
)");
}

// The same assembly with mapped items.
std::string step_of_mapped_items() {
  return with_lines(seed("step/cylinder"), R"(
#200 = SHAPE_DEFINITION_REPRESENTATION(#201,#204);
#201 = PRODUCT_DEFINITION_SHAPE('','',#202);
#202 = PRODUCT_DEFINITION('design','',#203,#9);
#203 = PRODUCT_DEFINITION_FORMATION('','',#7);
#204 = SHAPE_REPRESENTATION('',(#11,#210,#220),#113);
#205 = AXIS2_PLACEMENT_3D('',#206,#13,#14);
#206 = CARTESIAN_POINT('',(30.,0.,0.));
#207 = REPRESENTATION_MAP(#11,#10);
#208 = NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#202,#5,$);
#209 = PRODUCT_DEFINITION_SHAPE('','',#208);
#210 = MAPPED_ITEM('',#207,#11);
#220 = MAPPED_ITEM('',#207,#205);
)");
}

// The cylinder as a subfigure, and two instances of it.
std::string iges_of_instances() {
  std::string iges = seed("iges/cylinder");
  for (int i = 0; i < 2; ++i) iges = replaced(iges, "     402 ", "     308 ");
  iges = replaced(iges, "402,3,3,35,45;      ", "308,0,1HA,3,3,35,45;");
  for (const std::string at : {"55", "57"}) {
    const std::string next = at == "55" ? "56" : "58";
    const std::string row = at == "55" ? "28" : "29";
    const std::string directory =
        "     408      " + row +
        "       0       0       0       0       0       000000000D00000" + at +
        "\n     408       0       0       1       0                         "
        "      0D00000" +
        next + "\n";
    iges.insert(iges.find("308,0,1HA"), directory);
    iges.insert(iges.rfind("\nS ") + 1,
                "408,1," + std::string(at == "55" ? "00" : "30") +
                    ".,0.,0.,1.;                                              "
                    "00000" +
                    at + "P00000" + row + "\n");
  }
  return replaced(iges, "D     54P     27", "D     58P     29");
}

TEST_F(CadReader, CountsInstancesAndPartsWithoutTheirShape) {
  for (const auto& [bytes, format] :
       {std::pair(step_of_assembly(), Format::kStep),
        {step_of_mapped_items(), Format::kStep},
        {iges_of_instances(), Format::kIges}}) {
    const Part part = read(bytes, format);
    EXPECT_EQ(part.bodies.size(), 2U) << bytes;
    EXPECT_EQ(part.warnings, std::vector<std::string>());
  }
  const auto broken = [&](const std::string& from, const std::string& to) {
    return warning(replaced(step_of_assembly(), from, to), Format::kStep);
  };
  EXPECT_EQ(broken("#220 = CONTEXT", "#220 = KONTEXT"),
            "OpenCASCADE can't use 1 of 4 shapes of parts, 1 of 2 instances");
  EXPECT_EQ(broken("#3 = SHAPE_D", "#3 = SHAPE_X"),
            "OpenCASCADE can't use 1 of 4 shapes of parts");
  EXPECT_EQ(broken("'2','','',#202,#5", "'2','','',#202,#999"),
            "OpenCASCADE can't use 1 of 125 entities of shapes or units");
  EXPECT_EQ(broken("#222 = ITEM", "#225 = ITEM"),
            "OpenCASCADE can't use 1 of 124 entities of shapes or units");
  EXPECT_EQ(warning(replaced(step_of_mapped_items(), "#207,#205", "#207,#999"),
                    Format::kStep),
            "OpenCASCADE can't use 1 of 117 entities of shapes or units");
  EXPECT_EQ(warning(replaced(iges_of_instances(), "408,1,30.", "408,5,30."),
                    Format::kIges),
            "OpenCASCADE can't use 1 of 2 instances, 1 of 29 entities of "
            "shapes or units");
  EXPECT_EQ(
      warning(replaced(iges_of_instances(), "30.,0.,0.,1.;", "30.,0.,0.,0.;"),
              Format::kIges),
      "OpenCASCADE can't use 1 of 2 instances");
}

// A unit of no size that OpenCASCADE knows is a millimetre to it.
TEST_F(CadReader, CountsUnitsWithoutASize) {
  const auto inch = [](const std::string& unit) {
    return replaced(seed("step/cylinder"),
                    "#114 = ( LENGTH_UNIT() NAMED_UNIT(*) "
                    "SI_UNIT(.MILLI.,.METRE.) );",
                    "#114 = ( CONVERSION_BASED_UNIT('INCH',#200) LENGTH_UNIT() "
                    "NAMED_UNIT(#201) );\n"
                    "#200 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4)," +
                        unit +
                        ");\n#201 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,"
                        "0.);\n#202 = ( LENGTH_UNIT() NAMED_UNIT(*) "
                        "SI_UNIT(.MILLI.,.METRE.) );");
  };
  const Part sound = read(inch("#202"), Format::kStep);
  EXPECT_EQ(sound.warnings, std::vector<std::string>());
  EXPECT_NEAR(volume_of(sound.bodies[0].mesh) / kVolume, std::pow(25.4, 3), 20);
  EXPECT_EQ(warning(inch("#999"), Format::kStep),
            "OpenCASCADE can't use 1 of 112 entities of shapes or units");
}

// Whether OpenCASCADE knows them or not, shapes do not depend on them.
TEST_F(CadReader, CountsNoDimensionsTolerancesAndProperties) {
  const char* const kLines[] = {
      "#200 = DIMENSIONAL_SIZE(#201,'diameter');\n"
      "#201 = CONTACT_FEATURE('','',#4,.T.);\n",
      "#200 = DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#201,#203);\n"
      "#201 = DIMENSIONAL_SIZE(#202,'diameter');\n"
      "#202 = SHAPE_ASPECT('','',#4,.T.);\n"
      "#203 = SHAPE_DIMENSION_REPRESENTATION('',(#204),#113);\n"
      "#204 = UNKNOWN_ITEM('',5.);\n",
      "#200 = PLUS_MINUS_TOLERANCE(#202,#201);\n"
      "#201 = DIMENSIONAL_SIZE(#203,'diameter');\n"
      "#202 = UNKNOWN_TOLERANCE(0.1);\n"
      "#203 = SHAPE_ASPECT('','',#4,.T.);\n",
      "#200 = PROPERTY_DEFINITION_REPRESENTATION(#201,#202);\n"
      "#201 = PROPERTY_DEFINITION('','',#4);\n"
      "#202 = REPRESENTATION('',(),#203);\n"
      "#203 = UNKNOWN_CONTEXT('','');\n",
      "#200 = SHAPE_DEFINITION_REPRESENTATION(#201,#203);\n"
      "#201 = PROPERTY_DEFINITION('','',#202);\n"
      "#202 = UNKNOWN_ASPECT('','',#4,.T.);\n"
      "#203 = SHAPE_REPRESENTATION('',(#11,#204),#113);\n"
      "#204 = UNKNOWN_ITEM('');\n",
      "#200 = PROPERTY_DEFINITION('','',#201);\n"
      "#201 = UNKNOWN_PROPERTY('','');\n",
      "#200 = PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#7,#201));\n"
      "#201 = UNKNOWN_PRODUCT('');\n",
      "#200 = DRAUGHTING_MODEL('',(#201),#113);\n"
      "#201 = MAPPED_ITEM('',#202,#11);\n"
      "#202 = REPRESENTATION_MAP(#11,#10);\n"};
  for (const char* lines : kLines) {
    EXPECT_EQ(warning(with_lines(seed("step/cylinder"), lines), Format::kStep),
              "")
        << lines;
  }
}

TEST_F(CadReader, CountsTrianglesOnlyOfPartsThatHaveNoOtherShape) {
  const std::string copy =
      "#301 = SHAPE_REPRESENTATION_RELATIONSHIP('','',#10,#302);\n"
      "#302 = TESSELLATED_SHAPE_REPRESENTATION('',(#303),#113);\n"
      "#303 = TESSELLATED_SOLID('',(),$);\n";
  EXPECT_EQ(warning(with_lines(seed("step/cylinder"), copy), Format::kStep),
            "");
  EXPECT_EQ(warning(with_lines(step_of_assembly(), copy), Format::kStep), "");
  const std::string lone =
      "#304 = SHAPE_DEFINITION_REPRESENTATION(#305,#308);\n"
      "#305 = PRODUCT_DEFINITION_SHAPE('','',#306);\n"
      "#306 = PRODUCT_DEFINITION('other','',#307,#9);\n"
      "#307 = PRODUCT_DEFINITION_FORMATION('','',#7);\n"
      "#308 = SHAPE_REPRESENTATION('',(#11),#113);\n" +
      replaced(copy, "#10,", "#308,");
  EXPECT_EQ(warning(with_lines(seed("step/cylinder"), lone), Format::kStep),
            "OpenCASCADE can't use 1 of 116 entities of shapes or units");
}

// OpenCASCADE hides a lack of memory and goes on with less.
TEST_F(CadReader, LacksMemoryOrReadsTheWhole) {
  Reader reader({LAMINA_MODULES}, diagnostics_);
  expect_cylinder(reader.read(seed("step/cylinder"), Format::kStep, {}), 0.01);
  rlimit before{};
  ::getrlimit(RLIMIT_DATA, &before);
  int lacking = 0;
  int whole = 0;
  for (rlim_t size = 4 << 20; whole < 3; size += size / 64) {
    const rlimit less{size, before.rlim_max};
    ::setrlimit(RLIMIT_DATA, &less);
    std::optional<Part> part;
    try {
      part = reader.read(seed("step/cylinder"), Format::kStep,
                         {.chordal_error = 0.0002});
    } catch (const std::bad_alloc&) {
    }
    ::setrlimit(RLIMIT_DATA, &before);
    if (part) {
      ++whole;
      expect_cylinder(*part, 0.0002);
    } else {
      ++lacking;
    }
  }
  EXPECT_GT(lacking, 0);
}

TEST_F(CadReader, IsDeafToLocaleAndEnvironment) {
  setenv("CSF_STEPDefaults", "/nowhere", 1);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  expect_cylinder(read(seed("step/cylinder"), Format::kStep), 0.01);
  expect_cylinder(read(seed("iges/cylinder"), Format::kIges), 0.01);
  expect_cylinder(read(seed("brep/cylinder"), Format::kBrep), 0.01);
  std::setlocale(LC_ALL, "C");
  EXPECT_STREQ(std::getenv("CSF_STEPDefaults"), "/nowhere");
}

TEST_F(CadReader, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  read(seed("step/cylinder"), Format::kStep);
  failure(seed("brep/cylinder").substr(0, 400), Format::kBrep);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(CadReaderWithoutModule, SaysWhatHelps) {
  Diagnostics diagnostics;
  Reader reader({"/nowhere"}, diagnostics);
  EXPECT_THROW(reader.read("", Format::kStep, {}), GeometryError);
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].message,
            "Can't find the module for STEP, IGES and BREP, lamina_cad.so, in "
            "/nowhere");
  EXPECT_EQ(diagnostics.all()[0].hints.size(), 1U);
}

}  // namespace
}  // namespace lamina::cad
