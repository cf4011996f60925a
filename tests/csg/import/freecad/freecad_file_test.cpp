// FreeCAD files: what becomes of features is judged against FreeCAD itself
// (tests/oracle/freecad_test.cpp); here, which objects count, and that no file
// does harm.

#include "csg/import/freecad/freecad_file.h"

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/arena.h"
#include "base/file/format_error.h"
#include "csg/csg_printer.h"
#include "csg/limits.h"
#include "tests/csg/import/byte_changes.h"
#include "tests/csg/import/freecad/freecad_document.h"

namespace lamina::csg {
namespace {

// The tree as `.csg`, and all that was said.
struct Read {
  std::string csg;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
};

Read read(const std::string& bytes, FreecadOptions options = {}) {
  Tree tree;
  tree.arena = std::make_shared<Arena>();
  options.boundary_text = [](std::string_view, std::string_view name) {
    return fmt::format("import(part = \"{}\")", name);
  };
  FreecadModel model = read_freecad(bytes, options, *tree.arena);
  Node root;
  root.op = Group{};
  root.children = model.nodes;
  tree.root = &root;
  return {print_csg(tree, root), std::move(model.warnings),
          std::move(model.notes)};
}

std::string limit_of(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const plane::LimitExceeded& fault) {
    return fault.diagnostic().message;
  }
  return "";
}

// Bytes that no archive makes shorter: they keep its swelling low.
std::string noise_of(std::size_t size) {
  std::mt19937 random(1);
  std::string noise(size, ' ');
  for (char& c : noise) c = static_cast<char>(random() >> 24);
  return noise;
}

const std::string kBox = "cube(size = [3, 4, 5], center = false);\n";

const std::string kBoundary = "CASCADE Topology V1\nTShapes 1\nFa\n";

std::string cut(const std::string& base, const std::string& tool) {
  return link("Base", base) + link("Tool", tool);
}

// --- Which objects count ----------------------------------------------------

TEST(FreecadFile, ShowsWhatNoOtherObjectIsMadeOf) {
  FreecadDocument document;
  document.box("A").box("B", "2").add("Part::Cut", "C", cut("A", "B"));
  EXPECT_EQ(read(document.bytes()).csg,
            "difference() {\n\tcube(size = [3, 4, 5], center = false);\n"
            "\tcube(size = [2, 4, 5], center = false);\n}\n\n");
}

TEST(FreecadFile, LeavesOutWhatIsHiddenAndSaysSo) {
  FreecadDocument document;
  document.box("A").box("B", "2", flag("Visibility", false) + label("Jig"));
  const Read all = read(document.bytes());
  EXPECT_EQ(all.csg, kBox + "\n");
  EXPECT_EQ(all.notes,
            std::vector<std::string>{"hidden, so left out: 'Jig' (Part::Box)"});
  EXPECT_TRUE(all.warnings.empty());
}

TEST(FreecadFile, DoesNotCallAHiddenOperandLeftOut) {
  const std::string hidden = flag("Visibility", false);
  FreecadDocument document;
  document.box("A", "3", hidden)
      .box("B", "2", hidden)
      .box("C", "1", hidden)
      .add("Part::Cut", "D", cut("A", "B"));
  EXPECT_EQ(read(document.bytes()).notes,
            std::vector<std::string>{"hidden, so left out: 'C' (Part::Box)"});
}

TEST(FreecadFile, NamesWhatIsVisibleAndPartOfAnotherObject) {
  FreecadDocument document;
  document.box("A")
      .box("B", "2", flag("Visibility", false))
      .add("Part::Cut", "C", cut("A", "B"));
  EXPECT_EQ(read(document.bytes()).notes,
            std::vector<std::string>{"left out, as others that are shown are "
                                     "made of them: 'A' (Part::Box)"});
}

TEST(FreecadFile, KeepsAPartThatOnlyDrawingsAndFlatViewsAreMadeOf) {
  FreecadDocument document;
  document.box("A")
      .add("TechDraw::DrawViewPart", "View", links("Source", {"A"}))
      .add("Part::Part2DObjectPython", "Flat", link("Base", "A") + shape("f"))
      .add("Part::Section", "Section", cut("A", "A") + shape("s"));
  EXPECT_EQ(read(document.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, KeepsAPartThatOnlyHiddenObjectsAreMadeOf) {
  const std::string hidden = flag("Visibility", false);
  FreecadDocument document;
  document.box("A")
      .box("B", "2", hidden)
      .add("Part::Cut", "C", cut("A", "B") + hidden)
      .add("PartDesign::FeatureBase", "Clone", link("BaseFeature", "A"))
      .add("PartDesign::Body", "Body",
           links("Group", {"Clone"}) + link("Tip", "Clone") + hidden);
  EXPECT_EQ(read(document.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, LeavesOutWhatHiddenOperandsAndFeaturesAreMadeOf) {
  const std::string hidden = flag("Visibility", false);
  FreecadDocument document;
  document.box("A")
      .box("B", "2")
      .add("PartDesign::FeatureBase", "Clone",
           link("BaseFeature", "A") + hidden)
      .add("PartDesign::Body", "Body",
           links("Group", {"Clone"}) + link("Tip", "Clone") + hidden)
      .add("Part::Cut", "C", cut("Body", "B"));
  EXPECT_EQ(read(document.bytes()).csg,
            "difference() {\n\tcube(size = [3, 4, 5], center = false);\n"
            "\tcube(size = [2, 4, 5], center = false);\n}\n\n");
}

TEST(FreecadFile, TakesVisibilityFromTheGuisDocument) {
  FreecadDocument document;
  document.box("A").box("B", "2").entry(
      "GuiDocument.xml",
      "<Document><ViewProviderData><ViewProvider name=\"B\"><Properties>" +
          flag("Visibility", false) +
          "</Properties></ViewProvider></ViewProviderData></Document>");
  EXPECT_EQ(read(document.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, ShowsAMirrorImageBesideItsSource) {
  FreecadDocument document;
  document.box("A").box("B", "2");
  document.add("Part::Cut", "C", cut("A", "B"))
      .add("Part::Mirroring", "M",
           link("Source", "C") + vector("Base", "0", "0", "0") +
               vector("Normal", "1", "0", "0"));
  EXPECT_EQ(read(document.bytes()).notes,
            std::vector<std::string>{"left out, as others that are shown are "
                                     "made of them: 'A' (Part::Box), 'B' "
                                     "(Part::Box)"});
}

// Where FreeCAD's window shows both, both are there.
TEST(FreecadFile, ShowsWhatTheGuiShowsThoughOthersAreMadeOfIt) {
  FreecadDocument document;
  document.box("A")
      .box("B", "2")
      .add("Part::Cut", "C", cut("A", "B"))
      .entry(
          "GuiDocument.xml",
          "<Document><ViewProviderData><ViewProvider name=\"B\"><Properties>" +
              flag("Visibility", false) +
              "</Properties></ViewProvider></ViewProviderData></Document>");
  EXPECT_EQ(read(document.bytes()).csg,
            kBox +
                "difference() {\n\tcube(size = [3, 4, 5], center = false);\n"
                "\tcube(size = [2, 4, 5], center = false);\n}\n\n");
}

TEST(FreecadFile, ShowsTheVisibleMembersOfAHiddenPlainGroup) {
  FreecadDocument document;
  document.box("A").box("B", "2", flag("Visibility", false));
  document.add("App::DocumentObjectGroup", "G",
               links("Group", {"A", "B"}) + flag("Visibility", false),
               extension("App::GroupExtension"));
  EXPECT_EQ(read(document.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, MakesWhatGroupsOfAnyTypeHold) {
  FreecadDocument assembly;
  assembly.box("A").add("Assembly::AssemblyObject", "G",
                        links("Group", {"A"}) + placement_at_x("10"),
                        extension("App::OriginGroupExtension"));
  EXPECT_EQ(read(assembly.bytes()).csg,
            "multmatrix([[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0], "
            "[0, 0, 0, 1]]) {\n\t" +
                kBox + "}\n\n");
}

TEST(FreecadFile, LeavesMembersOfPlainGroupsInTheirPlace) {
  FreecadDocument storey;
  storey.box("A").add(
      "App::GeometryPython", "G",
      links("Group", {"A"}) + placement_at_x("10") + shape("Storey.brp"),
      extension("App::GroupExtensionPython"));
  EXPECT_EQ(read(storey.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, MakesWhatALayerListsOnce) {
  FreecadDocument document;
  document.box("A")
      .box("B", "2", flag("Visibility", false))
      .add("App::FeaturePython", "Layer", links("Group", {"A", "B"}))
      .add("App::Part", "P", links("Group", {"A"}));
  EXPECT_EQ(read(document.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, MakesShapesThatHoldOthersAndTheOthersToo) {
  FreecadDocument document;
  document.box("A")
      .add("Part::FeaturePython", "Wall", links("Group", {"A"}) + shape("w"),
           extension("App::GroupExtensionPython"))
      .entry("w", kBoundary);
  EXPECT_EQ(read(document.bytes()).csg, kBox + "import(part = \"Wall\");\n\n");
}

TEST(FreecadFile, MakesWhatAPartAndItsGroupNameOnce) {
  FreecadDocument document;
  document.box("A")
      .add("App::DocumentObjectGroup", "G", links("Group", {"A"}))
      .add("App::Part", "P", links("Group", {"A", "G"}));
  EXPECT_EQ(read(document.bytes()).csg, kBox + "\n");
}

TEST(FreecadFile, LeavesOutWhatAGroupOfLinksHides) {
  FreecadDocument document;
  document.box("A").box("B", "2").add(
      "App::LinkGroup", "G",
      links("ElementList", {"A", "B"}) +
          property("VisibilityList", "<BoolList value=\"01\"/>"));
  const Read all = read(document.bytes());
  EXPECT_EQ(all.csg, kBox + "\n");
  EXPECT_EQ(all.notes,
            std::vector<std::string>{"hidden, so left out: 'B' (Part::Box)"});
}

std::string linked_object(const std::string& attributes) {
  return property("LinkedObject", "<XLink " + attributes + "/>");
}

TEST(FreecadFile, FollowsLinksToAPartOfAnObject) {
  for (const std::string link : {"<XLink file=\"\" name=\"P\" sub=\"A.\"/>",
                                 "<XLink file=\"\" name=\"P\" sub=\"$Lid.\"/>",
                                 "<XLink file=\"\" name=\"P\" count=\"1\"><Sub "
                                 "value=\"A.\"/></XLink>"}) {
    FreecadDocument document;
    document.box("A", "3", placement_at_x("7") + label("Lid"))
        .add("App::Part", "P",
             links("Group", {"A"}) + placement_at_x("100") +
                 flag("Visibility", false))
        .add("App::Link", "L", property("LinkedObject", link));
    EXPECT_EQ(read(document.bytes()).csg,
              "multmatrix([[1, 0, 0, 7], [0, 1, 0, 0], [0, 0, 1, 0], "
              "[0, 0, 0, 1]]) {\n\t" +
                  kBox + "}\n\n");
  }
}

TEST(FreecadFile, NamesWhatALinkDoesNotFind) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"file=\"\" name=\"P\" sub=\"B.\"", "it links to 'B' of 'P' (App::Part)"},
      {"file=\"\" name=\"A\" sub=\"Face1\"",
       "it links to Face1 of 'A' (Part::Box)"},
      {"file=\"\" name=\"\"", "it links to nothing"},
      {"file=\"\" name=\"X\"", "there is no object 'X'"},
      {"file=\"b.FCStd\" name=\"A\"", "there is no file 'b.FCStd' to link to"}};
  for (const auto& [link, why] : cases) {
    FreecadDocument document;
    document.box("A").box("B").add("App::Part", "P", links("Group", {"A"}));
    document.add("App::Link", "L", linked_object(link));
    EXPECT_EQ(read(document.bytes()).warnings,
              std::vector<std::string>{"'L' (App::Link) is left out: " + why});
  }
}

TEST(FreecadFile, FollowsLinksIntoOtherFilesAndBack) {
  FreecadDocument first;
  first.box("A").add(
      "App::Link", "L",
      linked_object("file=\"b.FCStd\" name=\"P\"") + placement_at_x("50"));
  FreecadDocument second;
  second.box("C", "2", flag("Visibility", false))
      .add("App::Link", "Back", linked_object("file=\"a.FCStd\" name=\"A\""))
      .add("App::Part", "P", links("Group", {"C", "Back"}));
  std::vector<std::string> opened;
  FreecadOptions options;
  options.path = "a.FCStd";
  options.find_linked = [&](std::string_view from, std::string_view file) {
    opened.push_back(fmt::format("{} from {}", file, from));
    return file;
  };
  options.read_linked = [&](std::string_view) { return second.bytes(); };
  EXPECT_EQ(read(first.bytes(), options).csg,
            kBox +
                "multmatrix([[1, 0, 0, 50], [0, 1, 0, 0], [0, 0, 1, 0], "
                "[0, 0, 0, 1]]) {\n\t" +
                kBox + "}\n\n");
  EXPECT_EQ(opened, (std::vector<std::string>{"b.FCStd from a.FCStd",
                                              "a.FCStd from b.FCStd"}));
}

TEST(FreecadFile, RejectsFilesThatAreMadeOfOneAnother) {
  FreecadDocument file;
  file.add("App::Link", "L", linked_object("file=\"b\" name=\"L\""));
  FreecadOptions options;
  options.path = "a";
  options.find_linked = [&](std::string_view from, std::string_view) {
    return std::string_view(from == "a" ? "b" : "a");
  };
  options.read_linked = [&](std::string_view) { return file.bytes(); };
  EXPECT_EQ(fault_of([&] { read(file.bytes(), options); }),
            "FCStd, 'L' (App::Link) is made from itself");
}

TEST(FreecadFile, NamesTheLinkedFileThatIsBroken) {
  FreecadDocument file;
  file.add("App::Link", "L", linked_object("file=\"b.FCStd\" name=\"L\""));
  FreecadOptions options;
  options.find_linked = [](std::string_view, std::string_view linked) {
    return linked;
  };
  options.read_linked = [](std::string_view) { return "junk"; };
  EXPECT_EQ(fault_of([&] { read(file.bytes(), options); }),
            "FCStd, expected a ZIP archive, in 'b.FCStd', which a link names");
}

// Draft's arrays are links that store no shape, under names of their own.
TEST(FreecadFile, MakesArraysThatStoreNoShape) {
  FreecadDocument document;
  document.box("A").add(
      "Part::FeaturePython", "Array",
      "<_Property name=\"Shape\"/>" + link("Base", "A") +
          property("Count", "<Integer value=\"1\"/>") +
          property("PlacementList", "<PlacementList file=\"places\"/>"),
      extension("App::LinkExtensionPython"));
  std::string places("\1\0\0\0", 4);
  for (const double n : {20.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) {
    places.append(reinterpret_cast<const char*>(&n), sizeof n);
  }
  document.entry("places", places);
  EXPECT_EQ(read(document.bytes()).csg,
            "multmatrix([[1, 0, 0, 20], [0, 1, 0, 0], [0, 0, 1, 0], "
            "[0, 0, 0, 1]]) {\n\t" +
                kBox + "}\n\n");
}

TEST(FreecadFile, NamesShapesThatAreNotStored) {
  FreecadDocument document;
  document.box("A").add("New::Twist", "Twist", "<_Property name=\"Shape\"/>");
  EXPECT_EQ(read(document.bytes()).warnings,
            std::vector<std::string>{
                "'Twist' (New::Twist) is left out: it stores no faces"});
}

TEST(FreecadFile, MakesSolidsThatABodyBinds) {
  const std::string binder = "PartDesign::SubShapeBinder";
  FreecadDocument document;
  document.add(binder, "Solid", shape("solid"))
      .add(binder, "Face", shape("face"))
      .add("PartDesign::Body", "Body", links("Group", {"Solid", "Face"}))
      .entry("solid", kBoundary + "So\n")
      .entry("face", kBoundary);
  EXPECT_EQ(read(document.bytes()).csg, "import(part = \"Solid\");\n\n");
}

TEST(FreecadFile, GivesOneObjectByNameOrByLabel) {
  FreecadDocument document;
  document.box("A", "1", label("B")).box("B", "3", label("Lid"));
  FreecadOptions options;
  options.part = "B";
  EXPECT_EQ(read(document.bytes(), options).csg, kBox + "\n");
  options.part = "Lid";
  EXPECT_EQ(read(document.bytes(), options).csg, kBox + "\n");
  options.part = "Nut";
  EXPECT_EQ(fault_of([&] { read(document.bytes(), options); }),
            "FCStd, there is no part 'Nut'");
}

TEST(FreecadFile, TakesUnknownFeaturesByTheirBoundary) {
  FreecadDocument document;
  document.add("New::Twist", "Twist", shape("a.brp")).entry("a.brp", kBoundary);
  const Read all = read(document.bytes());
  EXPECT_EQ(all.csg, "import(part = \"Twist\");\n\n");
  EXPECT_EQ(all.notes, std::vector<std::string>{
                           "'Twist' (New::Twist) is taken by its boundary"});
}

TEST(FreecadFile, NamesWhatItLeavesOut) {
  FreecadDocument document;
  document.box("A")
      .add("New::Twist", "Twist", label("My twist") + shape("a.brp"))
      .entry("a.brp", "");
  EXPECT_EQ(read(document.bytes()).warnings,
            std::vector<std::string>{
                "'My twist' (New::Twist) is left out: it stores no faces"});
}

TEST(FreecadFile, SaysWhyAFeatureIsTakenByItsBoundary) {
  FreecadDocument document;
  document.box("A", "-3", shape("a.brp")).entry("a.brp", kBoundary);
  EXPECT_EQ(
      read(document.bytes()).notes,
      std::vector<std::string>{"'A' (Part::Box) is taken by its boundary: "
                               "its Length makes no solid"});
}

TEST(FreecadFile, MakesPrimitivesWhateverTheyName) {
  FreecadDocument document;
  document.box("A", "3", links("Group", {"B"}) + link("Base", "A"))
      .box("B", "2", link("Base", "A"));
  const Read all = read(document.bytes());
  EXPECT_EQ(all.csg, kBox + "cube(size = [2, 4, 5], center = false);\n\n");
  EXPECT_TRUE(all.notes.empty());
}

TEST(FreecadFile, NamesMembersThatTheFileLacks) {
  FreecadDocument document;
  document.box("A").add("App::Part", "P", links("Group", {"A", "B", "C"}));
  const Read all = read(document.bytes());
  EXPECT_EQ(all.csg, kBox + "\n");
  EXPECT_EQ(all.warnings,
            std::vector<std::string>{"'P' (App::Part) holds objects that the "
                                     "file lacks: 'B', 'C'"});
}

TEST(FreecadFile, NamesObjectsThatAreListedInPart) {
  std::string xml = FreecadDocument().box("A").box("B").box("C").xml();
  const std::string typed = "<Object type=\"Part::Box\" name=\"B\"/>";
  xml.replace(xml.find(typed), typed.size(), "");
  const std::string data = "<Object name=\"C\">";
  xml.replace(xml.find(data), data.size(), "<Object name=\"A\">");
  const Read all = read(make_zip({{"Document.xml", xml}}));
  EXPECT_EQ(all.csg, kBox + "\n");
  EXPECT_EQ(all.warnings, (std::vector<std::string>{
                              "left out, as the file has no type of them: 'B'",
                              "left out, as the file has no data of them: 'C'",
                              "left out, as others have their names: 'A'"}));
}

TEST(FreecadFile, NamesLinksWithoutVolume) {
  FreecadDocument document;
  document.box("A").add(
      "App::Link", "L",
      link("LinkedObject", "A") +
          property("ScaleVector",
                   "<PropertyVector valueX=\"0\" valueY=\"1\" "
                   "valueZ=\"1\"/>"));
  EXPECT_EQ(read(document.bytes()).warnings,
            std::vector<std::string>{"'L' (App::Link) is left out: its "
                                     "ScaleVector leaves no volume"});
}

TEST(FreecadFile, KeepsTheBytesOfABoundaryOnceForAllThatNameIt) {
  FreecadDocument document;
  document.add("New::Twist", "A", shape("a.brp"))
      .add("New::Twist", "B", shape("a.brp"))
      .entry("a.brp", kBoundary);
  Arena arena;
  FreecadOptions options;
  options.boundary_text = [](std::string_view, std::string_view name) {
    return std::string(name);
  };
  const std::string bytes = document.bytes();
  const FreecadModel model = read_freecad(bytes, options, arena);
  ASSERT_EQ(model.nodes.size(), 2U);
  EXPECT_EQ(model.nodes[0], model.nodes[1]);
  const auto* const import = std::get_if<Import>(&model.nodes[0]->op);
  ASSERT_NE(import, nullptr);
  EXPECT_EQ(import->params->boundary, kBoundary);
}

std::string sketch(const std::string& geometry) {
  return property("Geometry", "<GeometryList>" + geometry + "</GeometryList>");
}

std::string line(double x, double y, double end_x, double end_y) {
  return fmt::format(
      "<Geometry type=\"Part::GeomLineSegment\"><LineSegment StartX=\"{}\" "
      "StartY=\"{}\" EndX=\"{}\" EndY=\"{}\"/></Geometry>",
      x, y, end_x, end_y);
}

// An extrusion of an object 'Base'.
std::string extrusion() {
  return link("Base", "Base") + number("DirMode", "2") +
         number("LengthFwd", "5") + flag("Solid", true);
}

// An extrusion of a face that was told to make no solid.
std::string extrusion_of_plane(const std::string& boundary) {
  FreecadDocument document;
  document
      .add("Part::Plane", "Plane", number("Length", "3") + number("Width", "4"))
      .add("Part::Extrusion", "A",
           link("Base", "Plane") + number("DirMode", "2") +
               number("LengthFwd", "5") + flag("Solid", false) + shape("a.brp"))
      .entry("a.brp", boundary);
  return document.bytes();
}

TEST(FreecadFile, TakesAnExtrusionWhoseBoundaryIsASolid) {
  const Read solid = read(extrusion_of_plane(kBoundary + "So\n"));
  EXPECT_EQ(solid.csg, "import(part = \"A\");\n\n");
  EXPECT_TRUE(solid.warnings.empty());
}

TEST(FreecadFile, LeavesOutAnExtrusionWhoseBoundaryIsASurface) {
  const Read surface = read(extrusion_of_plane(kBoundary));
  EXPECT_EQ(surface.csg, "\n");
  EXPECT_EQ(surface.warnings,
            std::vector<std::string>{"'A' (Part::Extrusion) is left out: it "
                                     "makes a surface, no solid"});
}

// --- Hostile files ----------------------------------------------------------

std::string fault_of_bytes(const std::string& bytes) {
  return fault_of([&] { read(bytes); });
}

TEST(FreecadFile, RejectsWhatIsNoArchive) {
  EXPECT_EQ(fault_of_bytes(""), "FCStd, expected a ZIP archive");
  EXPECT_EQ(fault_of_bytes("solid"), "FCStd, expected a ZIP archive");
  EXPECT_EQ(fault_of_bytes(make_zip({{"a", "b"}})),
            "FCStd holds no 'Document.xml'");
  const std::string whole = FreecadDocument().box("A").bytes();
  EXPECT_EQ(fault_of_bytes(whole.substr(0, whole.size() / 2)),
            "ZIP archive is cut off: it has no directory");
}

TEST(FreecadFile, SurvivesEveryCutAndChangedByteOfItsDocument) {
  FreecadDocument document;
  document.add("Part::Fuse", "C", cut("C", "D"));
  expect_no_harm(document.xml(), [](std::string_view xml) {
    read(make_zip({{"Document.xml", std::string(xml)}}));
  });
}

TEST(FreecadFile, DoesNotExpandEntities) {
  std::string xml =
      "<?xml version='1.0'?><!DOCTYPE d [<!ENTITY a0 \"aaaaaaaa\">";
  for (int i = 1; i < 30; ++i) {
    xml += fmt::format("<!ENTITY a{0} \"&a{1};&a{1};&a{1};&a{1};\">", i, i - 1);
  }
  xml += "]>" + FreecadDocument().box("&a29;").xml().substr(38);
  EXPECT_EQ(fault_of_bytes(make_zip({{"Document.xml", xml}})), "");
}

TEST(FreecadFile, RejectsNumbersThatAreNone) {
  for (const std::string number : {"nan", "inf", "1e999", "x", ""}) {
    EXPECT_EQ(
        fault_of_bytes(FreecadDocument().box("A", number).bytes()),
        "FCStd, expected a number in value of a Float, not '" + number + "'");
  }
  EXPECT_EQ(fault_of_bytes(FreecadDocument().box("A", "1e300").bytes()),
            "FCStd, value of a Float is 1e+300, beyond 1e9");
}

TEST(FreecadFile, RejectsWhatIsMadeFromItself) {
  FreecadDocument cut_of_itself;
  cut_of_itself.box("A")
      .add("Part::Cut", "B", cut("A", "C"))
      .add("Part::Cut", "C", cut("B", "A"));
  FreecadOptions options;
  options.part = "C";
  EXPECT_EQ(fault_of([&] { read(cut_of_itself.bytes(), options); }),
            "FCStd, 'C' (Part::Cut) is made from itself");
  FreecadDocument ring;
  ring.add("App::Link", "L", link("LinkedObject", "M"))
      .add("App::Link", "M", link("LinkedObject", "L"));
  EXPECT_EQ(fault_of_bytes(ring.bytes()),
            "FCStd, 'L' (App::Link) is made from itself");
  FreecadDocument group;
  group.add("App::Part", "P", links("Group", {"Q"}))
      .add("App::Part", "Q", links("Group", {"P"}));
  options.part = "P";
  EXPECT_EQ(fault_of([&] { read(group.bytes(), options); }),
            "FCStd, 'P' (App::Part) is made from itself");
}

TEST(FreecadFile, RejectsWhatHoldsOrUsesItself) {
  FreecadDocument itself;
  itself.box("A").box("B").add("App::Part", "P", links("Group", {"P", "B"}));
  EXPECT_EQ(fault_of_bytes(itself.bytes()),
            "FCStd, 'P' (App::Part) is made from itself");
  FreecadDocument each_other;
  each_other.box("A")
      .box("B")
      .add("App::Part", "P", links("Group", {"Q"}))
      .add("App::Part", "Q", links("Group", {"P", "B"}));
  EXPECT_EQ(fault_of_bytes(each_other.bytes()),
            "FCStd, 'P' (App::Part) is made from itself");
  FreecadDocument shapes;
  shapes.box("A")
      .add("Part::Fillet", "F", link("Base", "G") + shape("a.brp"))
      .add("Part::Fillet", "G", link("Base", "F") + shape("a.brp"))
      .entry("a.brp", kBoundary);
  EXPECT_EQ(fault_of_bytes(shapes.bytes()),
            "FCStd, 'F' (Part::Fillet) is made from itself");
}

TEST(FreecadFile, RejectsAMissingBoundary) {
  FreecadDocument document;
  document.add("Part::Fillet", "A", shape("PartShape9.brp"));
  EXPECT_EQ(fault_of_bytes(document.bytes()),
            "FCStd holds no 'PartShape9.brp'");
}

TEST(FreecadFile, RejectsNestingBeyondAThousand) {
  FreecadDocument document;
  document.box("O0");
  for (int i = 1; i <= 1200; ++i) {
    document.add("Part::MultiFuse", fmt::format("O{}", i),
                 links("Shapes", {fmt::format("O{}", i - 1)}));
  }
  EXPECT_EQ(limit_of([&] { read(document.bytes()); }),
            "Too deep: 1000 objects are made of one another, at most 1000 can "
            "be, in 'O201' (Part::MultiFuse)");
}

TEST(FreecadFile, CountsLeavesOfObjectsThatDouble) {
  FreecadDocument document;
  document.box("O0");
  for (int i = 1; i <= 60; ++i) {
    const std::string last = fmt::format("O{}", i - 1);
    document.add("Part::MultiFuse", fmt::format("O{}", i),
                 links("Shapes", {last, last}));
  }
  EXPECT_EQ(limit_of([&] { read(document.bytes()); }),
            "Too many leaves: more than the 10000000 that --max-leaves allows, "
            "in 'O24' (Part::MultiFuse)");
}

// A circle of many edges.
std::string ring_of_lines(int count) {
  std::string lines;
  for (int i = 0; i < count; ++i) {
    const double a = i * 6.283 / count;
    const double b = (i + 1) % count * 6.283 / count;
    lines += line(std::cos(a), std::sin(a), std::cos(b), std::sin(b));
  }
  return lines;
}

TEST(FreecadFile, LimitsTheCornersOfAllOutlinesTogether) {
  FreecadDocument document;
  document.add("Sketcher::SketchObject", "Base", sketch(ring_of_lines(10'000)));
  for (int i = 0; i < 1'000; ++i) {
    document.add("Part::Extrusion", fmt::format("E{}", i), extrusion());
  }
  EXPECT_EQ(limit_of([&] { read(document.bytes()); }),
            "Too many corners: 4200000 of an outline, at most 4194304 can be, "
            "in 'E419' (Part::Extrusion)");
}

// Each of 220,000 corners.
TEST(FreecadFile, CountsTheCornersOfOutlinesThatAreOpen) {
  FreecadDocument document;
  for (int i = 0; i < 20; ++i) {
    document
        .add("Sketcher::SketchObject", fmt::format("S{}", i),
             sketch("<Geometry type=\"Part::GeomCircle\"><Circle "
                    "CenterX=\"0\" CenterY=\"0\" Radius=\"99999999\"/>"
                    "</Geometry>" +
                    line(0, 0, 1, 1)))
        .add("Part::Extrusion", fmt::format("E{}", i),
             link("Base", fmt::format("S{}", i)) + flag("Solid", true));
  }
  EXPECT_EQ(limit_of([&] { read(document.bytes()); }).substr(0, 17),
            "Too many corners:");
}

// Of 20,000 times 20 MB, if each were unpacked anew.
TEST(FreecadFile, LooksOnceIntoWhatManyObjectsStore) {
  FreecadDocument document;
  for (int i = 0; i < 20'000; ++i) {
    document.add("New::Twist", fmt::format("T{}", i), shape("a.brp"));
  }
  document.entry("a.brp", "Edges" + std::string(std::size_t{20} << 20, ' '))
      .entry("noise", noise_of(400'000));
  EXPECT_EQ(read(document.bytes()).warnings.size(), 20'000U);
}

// One large entry, or many that are not.
TEST(FreecadFile, DoesNotUnpackBombs) {
  const std::size_t size = std::size_t{4} << 20;
  FreecadDocument many;
  for (int i = 0; i < 8; ++i) {
    many.entry(fmt::format("{}.brp", i), std::string(size / 8, ' '));
  }
  for (const std::string& bytes :
       {make_zip({{"Document.xml", std::string(size, ' ')}}), many.bytes()}) {
    const std::string limit = limit_of([&] { read(bytes); });
    EXPECT_EQ(limit.substr(0, limit.find(" to 4")),
              fmt::format("FCStd of {} bytes unpacks", bytes.size()));
  }
}

TEST(FreecadFile, LimitsElementsBeforeTheyTakeMemory) {
  std::string xml = "<Document>";
  for (int i = 0; i < 9'000'000; ++i) xml += "<a/>";
  xml += "</Document>";
  const std::string bytes =
      make_zip({{"Document.xml", xml}, {"x", noise_of(800'000)}});
  EXPECT_EQ(limit_of([&] { read(bytes); }),
            "FCStd Document.xml has 9000002 elements and attributes, at most "
            "8388608 can be");
}

TEST(FreecadFile, LimitsTheGroupsOfAnObject) {
  FreecadDocument document;
  document.box("A");
  for (int i = 0; i < 101; ++i) {
    document.add("App::Part", fmt::format("G{}", i), links("Group", {"A"}));
  }
  EXPECT_EQ(limit_of([&] { read(document.bytes()); }),
            "Too many groups: more than 100 hold 'A' (Part::Box)");
}

TEST(FreecadFile, NamesTheObjectBeyondAllCoordinates) {
  FreecadDocument document;
  document
      .add("Sketcher::SketchObject", "Base",
           sketch("<Geometry type=\"Part::GeomCircle\"><Circle "
                  "CenterX=\"1e9\" CenterY=\"0\" Radius=\"5\"/></Geometry>"))
      .add("Part::Extrusion", "E", extrusion());
  EXPECT_EQ(limit_of([&] { read(document.bytes()); }),
            "Coordinates beyond 1e9 mm: too large for exact layers, in 'E' "
            "(Part::Extrusion)");
}

TEST(FreecadFile, LimitsSidesAndCorners) {
  FreecadDocument document;
  document.add("Part::Sphere", "A", number("Radius", "1e9"));
  FreecadOptions options;
  options.chordal_error = 1e-6;
  EXPECT_EQ(limit_of([&] { read(document.bytes(), options); }).substr(0, 19),
            "Too many fragments:");
}

}  // namespace
}  // namespace lamina::csg
