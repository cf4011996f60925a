// lamina as a library, as another program sees it: by its one header.

#include <cstdlib>
#include <filesystem>
#include <locale>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <lamina/design.h>

#include "tests/support/formulas.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace {

using lamina::Design;
using lamina::DesignOptions;
using lamina::Layer;
using lamina::SliceOptions;

SliceOptions layers_of(double thickness) {
  SliceOptions options;
  options.layer_thickness = thickness;
  return options;
}

SliceOptions at_heights(const std::vector<double>& heights) {
  SliceOptions options;
  options.heights = heights;
  return options;
}

// What `make` throws.
template <typename Make>
std::string fault_of(const Make& make) {
  try {
    make();
  } catch (const lamina::DesignError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

using lamina::support::polygon_area;

TEST(Design, GivesTheLayersOfATube) {
  const Design tube = Design::from_text(
      "difference() { cylinder(r = 5, h = 2, $fn = 32);"
      "  translate([0, 0, -1]) cylinder(r = 3, h = 4, $fn = 32); }");
  const std::vector<Layer> layers = tube.slice(layers_of(0.5));
  ASSERT_EQ(layers.size(), 4U);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Layer& layer = layers[i];
    EXPECT_DOUBLE_EQ(layer.bottom, 0.5 * static_cast<double>(i));
    EXPECT_DOUBLE_EQ(layer.top, 0.5 * static_cast<double>(i + 1));
    EXPECT_DOUBLE_EQ(layer.section_z, 0.5 * static_cast<double>(i) + 0.25);
    EXPECT_EQ(layer.loops.size(), 2U);
    EXPECT_NEAR(lamina::area(layer), polygon_area(32, 5) - polygon_area(32, 3),
                1e-9);
  }
}

TEST(Design, OuterLoopsArePositiveAndHolesNegative) {
  const Design block = Design::from_text(
      "difference() { cube(10); translate([2, 2, -1]) cube([3, 4, 12]); }");
  const std::vector<Layer> layers = block.slice(at_heights({-1, 5}));
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_TRUE(layers[0].loops.empty());
  ASSERT_EQ(layers[1].loops.size(), 2U);
  const double a = lamina::signed_area(layers[1].loops[0]);
  const double b = lamina::signed_area(layers[1].loops[1]);
  EXPECT_NEAR(std::max(a, b), 100, 1e-12);
  EXPECT_NEAR(std::min(a, b), -12, 1e-12);
}

TEST(Design, DefinitionsSetVariables) {
  DesignOptions options;
  options.definitions = {"a=3", "b=4"};
  const Design plate =
      Design::from_text("a = 1; b = 1; cube([a, b, 1]);", options);
  EXPECT_NEAR(lamina::area(plate.slice(at_heights({0.5}))[0]), 12, 1e-12);
}

TEST(Design, TextNeedsNoSetUp) {
  const Design letter = Design::from_text("linear_extrude(1) text(\"o\");");
  EXPECT_EQ(letter.slice(at_heights({0.5}))[0].loops.size(), 2U);
}

TEST(Design, ShowsEchoesAndWarnings) {
  std::string shown;
  DesignOptions options;
  options.show = [&](std::string_view message) { shown += message; };
  Design::from_text("echo(1 + 1); cube(unknown); cube(1);", options, "a.scad");
  EXPECT_NE(shown.find("ECHO: 2\n"), std::string::npos) << shown;
  EXPECT_NE(shown.find("a.scad:1:19: warning: Ignoring unknown variable"),
            std::string::npos)
      << shown;
}

TEST(Design, FaultsAreThrownWithTheirPlace) {
  const std::string syntax =
      fault_of([] { Design::from_text("cube(1)\nsphere(;", {}, "a.scad"); });
  EXPECT_EQ(syntax.substr(0, 7), "a.scad:") << syntax;
  const std::string assertion = fault_of(
      [] { Design::from_text("cube(1);\nassert(false);", {}, "a.scad"); });
  EXPECT_EQ(assertion.substr(0, 18), "a.scad:2:1: error:") << assertion;
  EXPECT_NE(
      fault_of([] { Design::from_file("missing.scad"); }).find("missing.scad"),
      std::string::npos);
  EXPECT_NE(
      fault_of([] { Design::from_text("square(1);"); }).find("not a 3D object"),
      std::string::npos);
  EXPECT_NE(fault_of([] { Design::from_text("echo(1);"); }).find("is empty"),
            std::string::npos);
}

TEST(Design, FaultsHaveTheirPlaceAndCallsAsData) {
  try {
    Design::from_text(
        "module inner(n) {\n  assert(n < 3, \"many\");\n}\n"
        "module outer() inner(4);\nouter();",
        {}, "a.scad");
    FAIL() << "nothing was thrown";
  } catch (const lamina::DesignError& error) {
    EXPECT_NE(error.fault.message.find("many"), std::string::npos);
    EXPECT_EQ(error.fault.file, "a.scad");
    EXPECT_EQ(error.fault.line, 2U);
    EXPECT_EQ(error.fault.column, 3U);
    ASSERT_GE(error.calls.size(), 2U);
    EXPECT_EQ(error.calls[error.calls.size() - 2].line, 4U);
    EXPECT_EQ(error.calls.back().line, 5U);
  }
}

TEST(Design, ValuesAreThoseThatTheCustomizerOffers) {
  const Design plate = Design::from_text(
      "a = 1; // [1 : 5]\nb = \"x\"; // [x, y]\ncube([a, b == \"y\" ? 2 : 1, "
      "1]);");
  const auto area_of = [](const Design& design) {
    return lamina::area(design.slice(at_heights({0.5}))[0]);
  };
  const Design other = plate.with({{"a", "3"}});
  EXPECT_NEAR(area_of(other), 3, 1e-12);
  EXPECT_NEAR(area_of(other.with({{"b", "y"}})), 6, 1e-12);
  EXPECT_EQ(other.parameters()[0].value, "3");
  for (const auto& [name, value] : lamina::ParameterValues{
           {"a", "9"}, {"a", "wide"}, {"b", "z"}, {"c", "1"}}) {
    EXPECT_THROW(plate.with({{name, value}}), lamina::DesignError)
        << name << " = " << value;
  }
}

TEST(Design, ReportsWhatThePieceWeighs) {
  DesignOptions options;
  options.metal = "silver-925";
  options.prices = {"2 EUR/g"};
  const Design cube = Design::from_text("cube(10);", options);
  const std::string report = cube.report(layers_of(0.5));
  EXPECT_NE(report.find("\"layers\":20,\"layer\":0.5,"), std::string::npos)
      << report;
  EXPECT_NE(report.find("\"currency\":\"EUR\""), std::string::npos) << report;
}

TEST(Design, SupportsStandOnTheBed) {
  DesignOptions options;
  options.supports = "0.4";
  const Design slab =
      Design::from_text("translate([0, 0, 5]) cube([6, 6, 1]);", options);
  ASSERT_FALSE(slab.supports().empty());
  for (const lamina::Support& support : slab.supports()) {
    EXPECT_TRUE(support.is_on_bed);
    EXPECT_DOUBLE_EQ(support.tip, 0.4);
    EXPECT_DOUBLE_EQ(support.z, 5);
  }
  EXPECT_LT(slab.slice(layers_of(0.1)).front().bottom, 1);
}

TEST(Design, AFaultInAUsedFileIsThrown) {
  const lamina::support::TemporaryFolder folder;
  folder.write("used.scad", "cube(;");
  const std::string design =
      folder.write("a.scad", "use <used.scad>\ncube(1);");
  EXPECT_NE(fault_of([&] { Design::from_file(design); }).find("used.scad"),
            std::string::npos);
}

TEST(Design, RefusesWhatCannotBeSliced) {
  const Design cube = Design::from_text("cube(1);");
  EXPECT_THROW(cube.slice(layers_of(0)), std::runtime_error);
  EXPECT_THROW(cube.slice(layers_of(NAN)), std::runtime_error);
  EXPECT_THROW(cube.slice(at_heights({0.5, 0.5})), std::runtime_error);
  SliceOptions intolerant;
  intolerant.tolerance = -1;
  EXPECT_THROW(cube.slice(intolerant), std::runtime_error);
  EXPECT_THROW(cube.write("cube.stl"), std::runtime_error);
  EXPECT_THROW(cube.write("cube.csg"), std::runtime_error);
  EXPECT_THROW(cube.find_thin_places(0), std::runtime_error);
  EXPECT_THROW(cube.write("missing/folder/cube.slc"), std::runtime_error);
}

TEST(Design, WritesTheBytesOfTheProgram) {
  const lamina::support::TemporaryFolder folder;
  const std::string design = folder.write(
      "a.scad", "difference() { sphere(5); rotate([30, 0, 0]) cube(4); }");
  const Design solid = Design::from_file(design);
  for (const std::string extension : {"slc", "cli", "svg", "layers.json"}) {
    solid.write(folder.file("library." + extension), layers_of(0.1));
    const auto program = lamina::support::run_process(
        {LAMINA_PROGRAM, design, "-o", "program." + extension, "--layer", "0.1",
         "-q"},
        folder.path());
    ASSERT_EQ(program.status, 0) << program.errors;
    EXPECT_EQ(lamina::support::read_file(folder.file("library." + extension)),
              lamina::support::read_file(folder.file("program." + extension)))
        << extension;
  }
}

TEST(Design, IsNotReplacedByItsLayers) {
  const lamina::support::TemporaryFolder folder;
  const std::string part = folder.write("part.svg", R"(<svg
    xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V9H0Z"/></svg>)");
  const std::string text = "linear_extrude(1) import(\"part.svg\");";
  const Design solid = Design::from_file(folder.write("a.scad", text));
  std::filesystem::create_symlink("a.scad", folder.file("a.slc"));
  for (const std::string name : {"a.slc", "part.svg"}) {
    EXPECT_NE(fault_of([&] {
                solid.write(folder.file(name));
              }).find("this run reads it, too"),
              std::string::npos)
        << name;
  }
  EXPECT_EQ(lamina::support::read_file(folder.file("a.scad")), text);
  // What was written may be written again.
  solid.write(folder.file("b.slc"));
  solid.write(folder.file("b.slc"));
}

std::string reason_of(const DesignOptions& options) {
  return fault_of([&] { Design::from_text("cube(1);", options); });
}

TEST(Design, RefusesOptionsThatMeanNothing) {
  DesignOptions axis;
  axis.axis = "up";
  EXPECT_NE(reason_of(axis).find("axis"), std::string::npos);
  DesignOptions scale;
  scale.scale = 0;
  EXPECT_NE(reason_of(scale).find("scale"), std::string::npos);
  DesignOptions set;
  set.parameter_set = "large";
  EXPECT_NE(reason_of(set).find("parameter_file"), std::string::npos);
  DesignOptions readable;
  readable.readable = {"."};
  EXPECT_NE(reason_of(readable).find("root"), std::string::npos);
  DesignOptions root;
  root.root = "nowhere";
  EXPECT_NE(reason_of(root).find("nowhere"), std::string::npos);
}

TEST(Design, AxisTurnsTheDesignAndTheBedLiftsIt) {
  DesignOptions options;
  options.axis = std::string("x");
  options.place_on_bed = true;
  const Design bar =
      Design::from_text("translate([5, 0, 0]) cube([8, 2, 3]);", options);
  const std::vector<Layer> layers = bar.slice(layers_of(1));
  ASSERT_EQ(layers.size(), 8U);
  EXPECT_DOUBLE_EQ(layers[0].bottom, 0);
  EXPECT_NEAR(lamina::area(layers[0]), 6, 1e-9);
}

TEST(Design, AutomaticAxisSaysWhatItChose) {
  std::string shown;
  DesignOptions options;
  options.axis = "auto";
  options.show = [&](std::string_view message) { shown += message; };
  const Design bar = Design::from_text("cube([8, 2, 3]);", options);
  EXPECT_NE(shown.find("building direction y"), std::string::npos) << shown;
  EXPECT_EQ(bar.slice(layers_of(1)).size(), 2U);
}

TEST(Design, AdaptiveLayersAreThickWhereWallsAreUpright) {
  const Design part = Design::from_text(
      "cylinder(r = 5, h = 8, $fn = 32);"
      "translate([0, 0, 8]) cylinder(r1 = 5, r2 = 1, h = 2, $fn = 32);");
  SliceOptions options = layers_of(0.1);
  options.adaptive = 0.1;
  options.max_layer = 0.4;
  const std::vector<Layer> layers = part.slice(options);
  EXPECT_NEAR(layers.front().top - layers.front().bottom, 0.4, 1e-9);
  EXPECT_NEAR(layers.back().top - layers.back().bottom, 0.1, 1e-9);
}

TEST(Design, LimitsEndAnEvaluation) {
  DesignOptions leaves;
  leaves.max_leaves = 3;
  EXPECT_THROW(Design::from_text("for (i = [1 : 4]) cube(i);", leaves),
               std::runtime_error);
  DesignOptions depth;
  depth.max_depth = 10;
  EXPECT_THROW(Design::from_text("function f(n) = n > 0 ? 1 + f(n - 1) : 1;"
                                 "cube(f(20));",
                                 depth),
               std::runtime_error);
}

TEST(Design, TheRootIsTheOnlyFolderThatIsUsed) {
  const lamina::support::TemporaryFolder root;
  const lamina::support::TemporaryFolder other;
  const std::string good = root.write("a.scad", "cube(1);");
  const std::string bad = other.write("b.scad", "cube(1);");
  DesignOptions options;
  options.root = root.path();
  const Design cube = Design::from_file(good, options);
  EXPECT_THROW(Design::from_file(bad, options), std::runtime_error);
  cube.write(root.file("a.slc"));
  EXPECT_THROW(cube.write(other.file("a.slc")), std::runtime_error);
  options.readable = {other.path()};
  Design::from_file(bad, options);
}

TEST(Design, NoImportRefusesData) {
  DesignOptions options;
  options.no_import = true;
  EXPECT_THROW(Design::from_text("import(\"a.stl\"); cube(1);", options),
               std::runtime_error);
}

TEST(Design, FindsThinPlacesAndTheLinesThatMadeThem) {
  const Design walls = Design::from_text(
      "cube([10, 0.3, 2]);\ntranslate([0, 5, 0]) cube([10, 3, 2]);", {},
      "a.scad");
  const std::vector<lamina::ThinPlace> places =
      walls.find_thin_places(0.5, layers_of(0.1));
  ASSERT_EQ(places.size(), 1U);
  EXPECT_TRUE(places[0].is_wall);
  EXPECT_NEAR(places[0].width, 0.3, 1e-6);
  EXPECT_NEAR(places[0].place.y, 0.15, 1e-6);
  EXPECT_NEAR(places[0].bottom, 0, 1e-9);
  EXPECT_NEAR(places[0].top, 2, 1e-9);
  EXPECT_EQ(places[0].source_line, "a.scad:1:1");
}

TEST(Design, ChecksThePrint) {
  const Design drop = Design::from_text(
      "cube(2);\ntranslate([0, 0, 3]) cube(1);\n", {}, "a.scad");
  const std::vector<lamina::Finding> findings = drop.check(layers_of(0.5));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].kind, lamina::Finding::Kind::kLoosePart);
  for (const lamina::Finding& finding : findings) {
    EXPECT_EQ(finding.first_layer, 7U);
    EXPECT_NEAR(finding.bottom, 3, 1e-9);
    EXPECT_NEAR(finding.area, 1, 1e-9);
    EXPECT_EQ(finding.source_line, "a.scad:2:22");
  }
  EXPECT_THROW(drop.check(at_heights({1})), std::runtime_error);
  EXPECT_TRUE(Design::from_text("cube(2);").check(layers_of(0.5)).empty());
}

TEST(Design, InspectsItsLayersAndThoseOfAFile) {
  const lamina::support::TemporaryFolder folder;
  const Design plate = Design::from_text(
      "difference() { cube([4, 3, 1]); translate([1, 1, -1]) cube([1, 1, 3]); }"
      "translate([6, 0, 0]) cube([0.2, 3, 1]);");
  plate.write(folder.file("a.layers.json"), layers_of(0.25));
  lamina::InspectOptions thin;
  thin.min_feature = 0.5;
  const lamina::Inspection made = plate.inspect(layers_of(0.25), thin);
  const lamina::Inspection read =
      lamina::inspect_file(folder.file("a.layers.json"), thin);
  EXPECT_EQ(made.format, "");
  EXPECT_NE(read.format, "");
  for (const lamina::Inspection& found : {made, read}) {
    ASSERT_EQ(found.layers.size(), 4U);
    EXPECT_EQ(found.layers[0].loops, 3U);
    EXPECT_EQ(found.layers[0].holes, 1U);
    EXPECT_NEAR(found.layers[0].area, 11.6, 1e-9);
    EXPECT_NEAR(found.layers[0].perimeter, 14 + 4 + 6.4, 1e-9);
    EXPECT_NEAR(found.volume, 11.6, 1e-9);
    EXPECT_EQ(found.defects, 0U);
    ASSERT_EQ(found.thin_places.size(), 1U);
    EXPECT_NEAR(found.thin_places[0].width, 0.2, 1e-6);
    // The square hole, open to the bed alone until it is done, is a small cup.
    ASSERT_EQ(found.findings.size(), 1U);
    EXPECT_TRUE(found.findings[0].is_minor);
  }
  EXPECT_NE(fault_of([&] {
              lamina::inspect_file(folder.file("missing.slc"));
            }).find("missing.slc"),
            std::string::npos);
}

TEST(Design, ListsTheParametersOfTheCustomizer) {
  const Design stone = Design::from_text(
      "/* [Stone] */\n// carat weight\ncarat = 0.5;  // [0.25:0.25:3]\n"
      "name = \"Ada\";\nmodule m() {}\nhidden = 1;\ncube(carat);");
  const std::vector<lamina::Parameter>& parameters = stone.parameters();
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].name, "carat");
  EXPECT_EQ(parameters[0].value, "0.5");
  EXPECT_EQ(parameters[0].choices, "[0.25 : 0.25 : 3]");
  EXPECT_EQ(parameters[0].description, "carat weight");
  EXPECT_EQ(parameters[0].group, "Stone");
  EXPECT_EQ(parameters[1].value, "\"Ada\"");
  EXPECT_EQ(parameters[1].choices, "");
}

TEST(Design, TakesAParameterSet) {
  const lamina::support::TemporaryFolder folder;
  DesignOptions options;
  options.parameter_file = folder.write(
      "sets.json", R"({"parameterSets": {"large": {"size": "3"}}})");
  options.parameter_set = "large";
  const Design cube = Design::from_text("size = 1;\ncube(size);", options);
  EXPECT_NEAR(lamina::area(cube.slice(at_heights({1}))[0]), 9, 1e-12);
}

TEST(Design, WritesTheImagesOfTheProgram) {
  const lamina::support::TemporaryFolder folder;
  const lamina::support::TemporaryFolder other;
  const std::string design = folder.write("a.scad", "cube([4, 6, 1]);");
  const std::string panel = folder.write(
      "tiny.json", R"({"name":"tiny","pixels":[16,16],"pixel_mm":[1,1],)"
                   R"("right":"+x","up":"+y"})");
  lamina::ImageOptions images;
  images.printer = panel;
  images.mirror_x = true;
  Design::from_file(design).write(other.file("a.sl1"), layers_of(0.5), images);
  const auto program = lamina::support::run_process(
      {LAMINA_PROGRAM, design, "-o", "a.sl1", "--layer", "0.5", "--printer",
       panel, "--mirror", "x", "-q"},
      folder.path());
  ASSERT_EQ(program.status, 0) << program.errors;
  EXPECT_EQ(lamina::support::read_file(other.file("a.sl1")),
            lamina::support::read_file(folder.file("a.sl1")));
}

// Another locale for the whole process, as a program around the library may
// have set it: decimal points are commas, thousands stand apart.
class GermanLocale {
 public:
  GermanLocale() {
    const auto made =
        lamina::support::run_process({"localedef", "-i", "de_DE", "-f", "UTF-8",
                                      folder_.file("de_DE.UTF-8")});
    EXPECT_EQ(made.status, 0) << made.errors;  // Debian's package locales
    ::setenv("LOCPATH", folder_.path().c_str(), 1);
    before_ = std::locale::global(std::locale("de_DE.UTF-8"));
  }
  ~GermanLocale() {
    std::locale::global(before_);
    ::unsetenv("LOCPATH");
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;

 private:
  lamina::support::TemporaryFolder folder_;
  std::locale before_;
};

// The same design in each format, and what it echoes.
std::vector<std::string> everything_of(const std::string& design) {
  std::vector<std::string> results(1);
  DesignOptions options;
  options.definitions = {"size=1234.5"};
  options.show = [&](std::string_view text) { results[0] += text; };
  const Design solid = Design::from_file(design, options);
  const lamina::support::TemporaryFolder folder;
  for (const std::string extension :
       {"slc", "cli", "svg", "slices.3mf", "layers.json"}) {
    const std::string path = folder.file("a." + extension);
    solid.write(path, layers_of(0.25));
    results.push_back(lamina::support::read_file(path));
  }
  return results;
}

TEST(Design, TheLocaleOfTheProcessDoesNotMatter) {
  const lamina::support::TemporaryFolder folder;
  folder.write("a.json", R"({"side": 2.75})");
  folder.write("a.svg",
               R"(<svg width="3.5mm" height="2.5mm" viewBox="0 0 3.5 2.5">)"
               R"(<path d="M 0.25,0.25 l 1.5 0 0 1.75 z"/></svg>)");
  folder.write("a.off",
               "OFF\n4 4 0\n0 0 0\n1.5 0 0\n0 1.25 0\n0 0 2.5\n"
               "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const std::string design = folder.write(
      "a.scad",
      "echo(size, 1.5e-400, 4.9e-324, 1 / 3, str(1e-7), import(\"a.json\"));"
      "linear_extrude(1.5) import(\"a.svg\"); import(\"a.off\");"
      "translate([size / 1000, 1.5e-400, 0.5]) cylinder(r = 1.75);");
  const std::vector<std::string> expected = everything_of(design);
  const GermanLocale german;
  EXPECT_EQ(std::to_string(0.5), "0,500000");
  EXPECT_EQ(everything_of(design), expected);
}

}  // namespace
