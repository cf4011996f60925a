// AMF and 3MF: XML, mostly zipped.

#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "base/file/zip.h"
#include "csg/import/mesh_file.h"
#include "tests/base/file/zip_writer.h"
#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

using namespace std::string_literals;

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1.5, 0, 0}, {0, 2, -0.25}};

const std::string kAmf = R"(<?xml version="1.0"?>
<amf unit="inch"><metadata type="x">y</metadata><object id="0"><mesh>
<vertices>
<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>
<vertex><coordinates><x> 1.5 </x><y>0</y><z>0</z></coordinates></vertex>
<vertex><coordinates><x>0</x><y>2</y><z>-0.25</z></coordinates></vertex>
</vertices>
<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>
</mesh></object><object id="1"/></amf>)";

const std::string k3mfModel = R"(<?xml version="1.0"?>
<model unit="millimeter" xmlns="urn:x"><resources>
<object id="1" type="model"><mesh>
<vertices><vertex x="0" y="0" z="0"/><vertex x="1.5" y="0" z="0"/>
<vertex x="0" y="2" z="-0.25"/></vertices>
<triangles><triangle v1="0" v2="1" v3="2"/></triangles>
</mesh></object></resources><build><item objectid="1"/></build></model>)";

const std::string kRelationships = R"(<?xml version="1.0"?>
<Relationships><Relationship Id="a" Target="/Metadata/thumbnail.png"
Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/>
<Relationship Id="b" Target="/other/part.model"
Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>)";

void expect_the_corners(const RawMesh& raw) {
  EXPECT_EQ(raw.mesh.vertices, kCorners);
  EXPECT_EQ(raw.mesh.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
}

TEST(ParseAmf, HasABodyForEachObject) {
  const auto bodies = parse_amf(kAmf, "a.amf").bodies;
  ASSERT_EQ(bodies.size(), 2U);
  expect_the_corners(bodies[0]);
  EXPECT_TRUE(bodies[1].mesh.triangles.empty());
}

TEST(ParseAmf, ReadsTheEntryOfItsOwnNameOrTheOnlyOne) {
  const auto named =
      parse_amf(make_zip({{"other", "x"}, {"a.amf", kAmf}}), "a.amf").bodies;
  expect_the_corners(named.at(0));
  expect_the_corners(
      parse_amf(make_zip({{"b.amf", kAmf}}), "a.amf").bodies.at(0));
  EXPECT_EQ(fault_of([] {
              parse_amf(make_zip({{"b", kAmf}, {"c", kAmf}}), "a.amf");
            }),
            "AMF archive holds no 'a.amf'");
}

TEST(ParseAmf, NamesWhatIsNoNumber) {
  std::string text = kAmf;
  text.replace(text.find("1.5"), 3, "one");
  EXPECT_EQ(fault_of([&] { parse_amf(text, "a.amf"); }),
            "AMF, expected a coordinate, not 'one'");
  text = kAmf;
  text.replace(text.find("<v3>2"), 5, "<v3>3");
  EXPECT_EQ(fault_of([&] { parse_amf(text, "a.amf"); }),
            "AMF, expected the index of a vertex, not '3'");
}

TEST(ParseAmf, EntitiesDoNotGrow) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE amf [<!ENTITY a \"0123456789\">";
  for (char c = 'b'; c <= 'z'; ++c) {
    text += std::string("<!ENTITY ") + c + " \"";
    for (int i = 0; i < 10; ++i) {
      text += '&';
      text += static_cast<char>(c - 1);
      text += ';';
    }
    text += "\">";
  }
  text += "]>\n<amf><object>&z;</object></amf>";
  EXPECT_EQ(parse_amf(text, "a.amf").bodies.size(), 1U);
}

// Objects that double with each step, with a mesh at the end or without one.
TEST(Parse3mf, RejectsObjectsThatDoubleTooOften) {
  const std::string mesh =
      k3mfModel.substr(k3mfModel.find("<mesh>"),
                       k3mfModel.find("</object>") - k3mfModel.find("<mesh>"));
  for (const std::string& end : {mesh, std::string()}) {
    std::string objects;
    for (int id = 1; id < 60; ++id) {
      const std::string component =
          fmt::format("<component objectid=\"{}\"/>", id + 1);
      objects += fmt::format(
          "<object id=\"{}\"><components>{}{}</components></object>", id,
          component, component);
    }
    const std::string bytes = make_zip(
        {{"3D/3dmodel.model",
          fmt::format("<model><resources>{}<object id=\"60\">{}</object>"
                      "</resources><build><item objectid=\"1\"/></build>"
                      "</model>",
                      objects, end)}});
    const std::string words = "3MF, too many components of components";
    EXPECT_EQ(fault_of([&] { parse_3mf(bytes, Placing::kFile); }), words);
    EXPECT_EQ(fault_of([&] { threemf_parts(bytes); }), words);
  }
}

TEST(Parse3mf, ReadsThePartThatThePackageNames) {
  const auto bodies = parse_3mf(make_zip({{"3D/3dmodel.model", "not this one"},
                                          {"_rels/.rels", kRelationships},
                                          {"other/part.model", k3mfModel}}))
                          .bodies;
  ASSERT_EQ(bodies.size(), 1U);
  expect_the_corners(bodies[0]);
}

TEST(Parse3mf, ReadsTheUsualPartWithoutRelationships) {
  const auto bodies =
      parse_3mf(make_zip({{"3D/3dmodel.model", k3mfModel}})).bodies;
  ASSERT_EQ(bodies.size(), 1U);
  expect_the_corners(bodies[0]);
}

TEST(Parse3mf, SaysWhatIsWrong) {
  EXPECT_EQ(fault_of([] { parse_3mf("garbage"); }), "not a ZIP archive");
  EXPECT_EQ(fault_of([] {
              parse_3mf(make_zip({{"a", "b"}}));
            }),
            "3MF holds no '3D/3dmodel.model'");
  std::string model = k3mfModel;
  model.replace(model.find("v3=\"2\""), 6, "v3=\"3\"");
  EXPECT_EQ(fault_of([&] {
              parse_3mf(make_zip({{"3D/3dmodel.model", model}}));
            }),
            "3MF, there is no vertex 3");
}

// --- Placing -----------------------------------------------------------------

// A triangle with its first corner at the origin, in a unit.
std::string model_of(const std::string& resources, const std::string& build,
                     const std::string& unit = "millimeter") {
  return "<model unit=\"" + unit +
         "\" xmlns=\"urn:x\" xmlns:p=\"urn:p\"><resources>" + resources +
         "</resources><build>" + build + "</build></model>";
}
std::string triangle(const std::string& id) {
  return "<object id=\"" + id +
         "\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" "
         "y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices>"
         "<triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh>"
         "</object>";
}
PlacedMeshes read_placed(const std::string& model, Placing placing,
                         const std::string& other = "") {
  return parse_3mf(
      make_zip({{"3D/3dmodel.model", model}, {"3D/Objects/o.model", other}}),
      placing);
}
std::vector<Vec3> first_corners(const PlacedMeshes& meshes) {
  std::vector<Vec3> corners;
  for (const RawMesh& raw : meshes.bodies) {
    corners.push_back(raw.mesh.vertices.at(0));
  }
  return corners;
}

// Turns by a quarter about z; moves by 10 along x.
const std::string kTurn = "transform=\"0 1 0 -1 0 0 0 0 1 0 0 0\"";
const std::string kMove = "transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"";

TEST(Parse3mf, PlacesItemsAsTheFileSays) {
  const std::string model =
      model_of(triangle("1") +
                   "<object id=\"2\"><components><component objectid=\"1\" " +
                   kMove + "/></components></object>",
               "<item objectid=\"1\"/><item objectid=\"1\" " + kMove +
                   "/><item objectid=\"2\" " + kTurn + "/>");
  // What stands outside is applied last; OpenSCAD applies it first.
  EXPECT_EQ(first_corners(read_placed(model, Placing::kFile)),
            (std::vector<Vec3>{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}));
  EXPECT_EQ(first_corners(read_placed(model, Placing::kOpenScad)),
            (std::vector<Vec3>{{0, 0, 0}, {10, 0, 0}, {10, 0, 0}}));
  const PlacedMeshes lying = read_placed(model, Placing::kNone);
  EXPECT_EQ(first_corners(lying), (std::vector<Vec3>{{0, 0, 0}}));
  ASSERT_EQ(lying.passed_over.size(), 1U);
  EXPECT_TRUE(lying.passed_over[0].starts_with("places 3 items, and "));
}

TEST(Parse3mf, SaysNothingOfObjectsThatLieWhereTheyArePlaced) {
  const std::string model =
      model_of(triangle("1") + triangle("2"),
               "<item objectid=\"1\"/><item objectid=\"2\"/>");
  EXPECT_TRUE(read_placed(model, Placing::kNone).passed_over.empty());
}

TEST(Parse3mf, ReadsObjectsOfOtherParts) {
  const std::string model = model_of(
      "<object id=\"1\"><components><component p:path=\"/3D/Objects/o.model\" "
      "objectid=\"1\" " +
          kMove + "/></components></object>",
      "<item objectid=\"1\" " + kMove + "/>");
  const std::string other = model_of(triangle("1"), "");
  EXPECT_EQ(first_corners(read_placed(model, Placing::kFile, other)),
            (std::vector<Vec3>{{20, 0, 0}}));
  EXPECT_EQ(first_corners(read_placed(model, Placing::kNone, other)),
            (std::vector<Vec3>{{0, 0, 0}}));
}

TEST(Parse3mf, HeedsUnitsOrSaysThatItDoesNot) {
  const std::string model =
      model_of(triangle("1"), "<item objectid=\"1\" " + kMove + "/>", "inch");
  EXPECT_EQ(first_corners(read_placed(model, Placing::kFile)),
            (std::vector<Vec3>{{254, 0, 0}}));
  const PlacedMeshes taken = read_placed(model, Placing::kOpenScad);
  EXPECT_EQ(first_corners(taken), (std::vector<Vec3>{{10, 0, 0}}));
  EXPECT_EQ(taken.passed_over,
            std::vector<std::string>{"has lengths in the unit 'inch', taken "
                                     "for millimetres as in OpenSCAD"});
}

TEST(Parse3mf, LeavesOutWhatSlicersAddForThemselves) {
  const std::string model = model_of(
      triangle("1") + triangle("2") +
          "<object id=\"3\"><components><component objectid=\"1\"/><component "
          "objectid=\"2\"/></components></object>",
      "<item objectid=\"3\"/>");
  const auto read = [&](const std::string& name, const std::string& config) {
    return parse_3mf(make_zip({{"3D/3dmodel.model", model}, {name, config}}),
                     Placing::kFile);
  };
  const auto count = [](const PlacedMeshes& meshes) {
    std::size_t triangles = 0;
    for (const RawMesh& raw : meshes.bodies) {
      triangles += raw.mesh.triangles.size();
    }
    return triangles;
  };
  const PlacedMeshes of_bambu =
      read("Metadata/model_settings.config",
           R"(<config><object id="3"><part id="1" subtype="normal_part"/>
<part id="2" subtype="modifier_part"/></object></config>)");
  EXPECT_EQ(count(of_bambu), 1U);
  ASSERT_EQ(of_bambu.passed_over.size(), 1U);
  EXPECT_TRUE(of_bambu.passed_over[0].starts_with("has 1 volume for a slicer"));
  EXPECT_EQ(count(read("Metadata/Slic3r_PE_model.config",
                       R"(<config><object id="2"><volume firstid="0" lastid="0">
<metadata type="volume" key="volume_type" value="SupportBlocker"/></volume>
</object></config>)")),
            1U);
  EXPECT_EQ(count(read("Metadata/Slic3r_PE_model.config",
                       R"(<config><object id="2"><volume firstid="0" lastid="0">
<metadata type="volume" key="volume_type" value="ModelPart"/></volume>
</object></config>)")),
            2U);
}

TEST(Parse3mf, RefusesPartsThatSwellTogether) {
  std::string components;
  std::vector<std::pair<std::string, std::string>> entries;
  for (int i = 0; i < 20; ++i) {
    const std::string name = "p" + std::to_string(i);
    components += "<component path=\"/" + name + "\" objectid=\"1\"/>";
    entries.push_back(
        {name, "<model>" + std::string(200'000, ' ') + "</model>"});
  }
  entries.push_back(
      {"3D/3dmodel.model", model_of("<object id=\"1\"><components>" +
                                        components + "</components></object>",
                                    "")});
  EXPECT_EQ(fault_of([&] { parse_3mf(make_zip(entries)); }),
            "3MF, the parts are too large");
}

TEST(ParseAmf, PlacesInstancesInItsUnit) {
  std::string text = kAmf;
  text.replace(text.find("</amf>"), 6,
               "<constellation id=\"2\"><instance objectid=\"0\"><deltax>2"
               "</deltax><rz>90</rz></instance><instance objectid=\"0\"/>"
               "</constellation></amf>");
  const auto bodies = parse_amf(text, "a.amf", Placing::kFile).bodies;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].mesh.vertices.at(1), 25.4 * Vec3(2, 1.5, 0));
  EXPECT_EQ(bodies[1].mesh.vertices.at(1), 25.4 * Vec3(1.5, 0, 0));
  EXPECT_EQ(parse_amf(text, "a.amf").passed_over.size(), 2U);
}

TEST(ZipArchive, KeepsOfNamesWhatTheyTake) {
  const ZipArchive archive =
      ZipArchive::open(make_zip({{"a", ""}, {std::string(300, 'b'), ""}}));
  ASSERT_EQ(archive.names().size(), 2U);
  EXPECT_LT(archive.names()[0].capacity(), 100U);
  EXPECT_EQ(archive.names()[1], std::string(300, 'b'));
  EXPECT_LT(archive.names()[1].capacity(), 1000U);
}

TEST(ZipArchive, ReadsTheFirstOfEqualNamesAndCountsAll) {
  const std::string bytes = make_zip({{"a", "one"}, {"b", ""}, {"a", "three"}});
  const ZipArchive archive = ZipArchive::open(bytes);
  EXPECT_EQ(archive.read("a"), "one");
  EXPECT_EQ(archive.read("A"), std::nullopt);
  EXPECT_EQ(archive.unpacked_bytes(), 8);
}

std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (; bytes > 0; --bytes, number >>= 8) text += static_cast<char>(number);
  return text;
}

// An archive of one entry, stored, whose sizes and places are of 64 bits, as
// lib3mf writes them.
std::string make_wide_zip(const std::string& name, const std::string& contents,
                          std::uint16_t flags = 0, std::uint16_t method = 0) {
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(contents.data()),
                           contents.size());
  const std::string elsewhere(4, '\xff');
  const std::string sizes =
      little_endian(contents.size(), 8) + little_endian(contents.size(), 8);
  const std::string middle = little_endian(45, 2) + little_endian(flags, 2) +
                             little_endian(method, 2) + little_endian(0, 4) +
                             little_endian(crc, 4) + elsewhere + elsewhere +
                             little_endian(name.size(), 2);
  const std::string entry = "PK\3\4" + middle + little_endian(20, 2) + name +
                            little_endian(1, 2) + little_endian(16, 2) + sizes +
                            contents;
  const std::string directory =
      "PK\1\2" + little_endian(45, 2) + middle + little_endian(28, 2) +
      little_endian(0, 10) + elsewhere + name + little_endian(1, 2) +
      little_endian(24, 2) + sizes + little_endian(0, 8);
  const std::string end =
      "PK\6\6" + little_endian(44, 8) + little_endian(45, 2) +
      little_endian(45, 2) + little_endian(0, 8) + little_endian(1, 8) +
      little_endian(1, 8) + little_endian(directory.size(), 8) +
      little_endian(entry.size(), 8) + "PK\6\7" + little_endian(0, 4) +
      little_endian(entry.size() + directory.size(), 8) + little_endian(1, 4) +
      "PK\5\6" + little_endian(0, 4) + little_endian(1, 2) +
      little_endian(1, 2) + little_endian(directory.size(), 4) + elsewhere +
      little_endian(0, 2);
  return entry + directory + end;
}

TEST(ZipArchive, ReadsSizesOf64Bits) {
  const std::string bytes = make_wide_zip("a", "contents");
  const ZipArchive archive = ZipArchive::open(bytes);
  EXPECT_EQ(archive.read("a"), "contents");
  EXPECT_EQ(archive.unpacked_bytes(), 8);
}

TEST(ZipArchive, StandsBehindOtherBytes) {
  const std::string bytes = "#!/bin/sh\n" + make_zip({{"a", "contents"}});
  EXPECT_EQ(ZipArchive::open(bytes).read("a"), "contents");
}

TEST(ZipArchive, SaysWhatItCannotUnpack) {
  const std::string locked = make_wide_zip("a", "x", 1);
  EXPECT_EQ(fault_of([&] { ZipArchive::open(locked).read("a"); }),
            "ZIP entry 'a' is encrypted");
  const std::string packed = make_wide_zip("a", "x", 0, 12);
  EXPECT_EQ(fault_of([&] { ZipArchive::open(packed).read("a"); }),
            "ZIP entry 'a' is packed by method 12: expected Deflate");
  std::string broken = make_wide_zip("a", "contents");
  broken[broken.find("contents")] = 'C';
  EXPECT_EQ(fault_of([&] { ZipArchive::open(broken).read("a"); }),
            "ZIP entry 'a' is broken");
}

TEST(ZipArchive, UnpacksNoMoreThanItsDirectorySays) {
  std::string bytes = make_wide_zip("a", "contents");
  bytes[bytes.rfind("\x01\0\x18\0"s) + 4] = 7;
  const ZipArchive archive = ZipArchive::open(bytes);
  EXPECT_EQ(archive.unpacked_bytes(), 7);
  EXPECT_EQ(fault_of([&] { archive.read("a"); }), "ZIP entry 'a' is broken");
}

TEST(ZipArchive, RefusesToSwellWithoutEnd) {
  const std::string bytes =
      make_zip({{"bomb", std::string(std::size_t{400} << 20, 'x')}});
  ASSERT_LT(bytes.size(), std::size_t{1} << 20);
  EXPECT_EQ(fault_of([&] { ZipArchive::open(bytes).read("bomb"); }),
            "ZIP entry 'bomb' is too large");
}

TEST(Archives, SurviveWhateverBefallsAFile) {
  const auto amf = [](std::string_view bytes) {
    for (const RawMesh& raw :
         parse_amf(bytes, "a.amf", Placing::kFile).bodies) {
      expect_whole(raw);
    }
  };
  const auto threemf = [](std::string_view bytes) {
    for (const RawMesh& raw : parse_3mf(bytes, Placing::kFile).bodies) {
      expect_whole(raw);
    }
  };
  expect_no_harm(kAmf, amf);
  expect_no_harm(make_zip({{"a.amf", kAmf}}), amf);
  expect_no_harm(make_zip({{"3D/3dmodel.model", k3mfModel}}), threemf);
  expect_no_harm(make_wide_zip("3D/3dmodel.model", k3mfModel), threemf);
}

}  // namespace
}  // namespace lamina::csg
