// Many pieces on the plates of a printer: `lamina plate`.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/vec.h"
#include "plane/predicates.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::has;
using support::read_file;
using support::TemporaryFolder;

using Loop = std::vector<Vec2>;

struct PlateLayer {
  double bottom = 0;
  std::vector<Loop> loops;
};

// A file of .layers.json.
std::vector<PlateLayer> plate_layers_of(const TemporaryFolder& folder,
                                        const std::string& name) {
  const json file = json::parse(read_file(folder.file(name)));
  std::vector<PlateLayer> layers;
  for (const json& layer : file["layers"]) {
    PlateLayer& read = layers.emplace_back();
    read.bottom = layer["bottom"];
    for (const json& contour : layer["contours"]) {
      Loop& loop = read.loops.emplace_back();
      for (const json& point : contour["points"])
        loop.emplace_back(point[0], point[1]);
    }
  }
  return layers;
}

double area_of(const PlateLayer& layer) {
  double area = 0;
  for (const Loop& loop : layer.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      area += cross(loop[i], loop[(i + 1) % loop.size()]) / 2;
    }
  }
  return area;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos;
       at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

// A folder with designs.
class PlateCommand : public ::testing::Test {
 protected:
  PlateCommand() {
    folder_.write("cube.scad", "size = 5;\ncube([size, size, 2 * size]);\n");
    folder_.write("cone.scad",
                  "n = 5;\ncylinder(r1 = 4, r2 = 2, h = 3, $fn = n);\n");
    folder_.write("ell.scad",
                  "difference() { cube([9, 9, 6]); translate([3, 3, -1]) "
                  "cube(9); }\n");
  }

  // On plates of 60 by 40 mm, with layers of 0.5 mm.
  support::ProcessResult plate(std::vector<std::string> words) const {
    words.insert(words.begin(), "plate");
    words.insert(words.end(), {"--plate", "60,40", "--layer", "0.5"});
    return run(folder_, words);
  }

  // The message of a run that must fail and write nothing.
  std::string failure(std::vector<std::string> words, int status = 1) const {
    const std::size_t entries = folder_.entry_count();
    const auto result = plate(std::move(words));
    EXPECT_EQ(result.status, status) << result.errors;
    EXPECT_EQ(folder_.entry_count(), entries) << result.errors;
    return result.errors;
  }

  // That of a table.
  std::string failure_of_table(const std::string& table) const {
    folder_.write("t.csv", table);
    return failure({"--table", "t.csv", "-o", "p-{plate}.slc"});
  }

  json map_of(std::vector<std::string> words) const {
    words.insert(words.end(), {"--map", "map.json"});
    const auto result = plate(std::move(words));
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(read_file(folder_.file("map.json")));
  }

  TemporaryFolder folder_;
};

TEST_F(PlateCommand, TwoCopiesHaveTwiceTheArea) {
  ASSERT_EQ(run(folder_,
                {"cube.scad", "--layer", "0.5", "-q", "-o", "one.layers.json"})
                .status,
            0);
  const auto result =
      plate({"cube.scad", "--copies", "2", "-o", "two.layers.json"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(result.errors, "two.layers.json: 2 pieces, 20 layers\n");
  const auto one = plate_layers_of(folder_, "one.layers.json");
  const auto two = plate_layers_of(folder_, "two.layers.json");
  ASSERT_EQ(one.size(), 20U);
  ASSERT_EQ(two.size(), 20U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(two[i].bottom, one[i].bottom);
    EXPECT_NEAR(area_of(two[i]), 2 * area_of(one[i]), 1e-9);
  }
}

// A file of the printer's has them too.
TEST_F(PlateCommand, WritesWhatThePrinterReads) {
  const auto result =
      run(folder_, {"plate", "cube.scad", "--copies", "30", "--printer",
                    "elegoo-mars-4", "--layer", "0.5", "-o", "out/p-{plate}"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto inspected = run(folder_, {"inspect", "out/p-1.goo", "--json"});
  EXPECT_NEAR(json::parse(inspected.output)["volume_mm3"], 30 * 250, 30);
}

// Laws: areas add up in every layer, and no two pieces come near each other.
TEST_F(PlateCommand, LayersAreThoseOfThePieces) {
  const std::vector<std::pair<std::string, std::size_t>> orders = {
      {"cube", 4}, {"cone", 5}, {"ell", 6}};
  std::string table = "design,quantity\n";
  std::vector<double> expected(20);
  for (const auto& [name, quantity] : orders) {
    table += fmt::format("{}.scad,{}\n", name, quantity);
    ASSERT_EQ(run(folder_, {name + ".scad", "--layer", "0.5", "-q", "-o",
                            name + ".layers.json"})
                  .status,
              0);
    const auto layers = plate_layers_of(folder_, name + ".layers.json");
    for (std::size_t i = 0; i < layers.size(); ++i) {
      expected[i] += static_cast<double>(quantity) * area_of(layers[i]);
    }
  }
  folder_.write("t.csv", table);
  const json map = map_of({"--table", "t.csv", "-o", "p.layers.json", "--gap",
                           "1.5", "--turns", "12"});
  bool is_turned = false;
  for (const json& piece : map[0]["pieces"]) {
    is_turned = is_turned || piece["turn_deg"] != 0;
  }
  EXPECT_TRUE(is_turned);
  const auto layers = plate_layers_of(folder_, "p.layers.json");
  ASSERT_EQ(layers.size(), 20U);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_NEAR(area_of(layers[i]), expected[i], 1e-6) << i;
    const std::vector<Loop>& loops = layers[i].loops;
    // Each piece is one loop.
    for (std::size_t a = 0; a < loops.size(); ++a) {
      for (const Vec2 p : loops[a]) {
        EXPECT_GE(std::min({p.x, p.y, 60 - p.x, 40 - p.y}), 1 - 1e-6);
        for (std::size_t b = 0; b < loops.size(); ++b) {
          if (a == b) continue;
          for (std::size_t k = 0; k < loops[b].size(); ++k) {
            EXPECT_GE(distance_to_segment(p, loops[b][k],
                                          loops[b][(k + 1) % loops[b].size()]),
                      1.5 - 1e-6)
                << i;
          }
        }
      }
    }
  }
}

// --- Orders -----------------------------------------------------------------

TEST_F(PlateCommand, ATableSetsVariablesAndQuantities) {
  folder_.write("t.csv",
                "name,design,quantity,size,n\n"
                "Ada,cube.scad,2,3,\n"
                "Ben,cone.scad,1,,7\n"
                ",,1,4,\n"
                "Eve,cube.scad,0,9,\n");
  const json map =
      map_of({"cube.scad", "--table", "t.csv", "-o", "p.layers.json"});
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map[0]["output"], "p.layers.json");
  EXPECT_EQ(map[0]["layers"], 16);
  std::vector<std::string> names;
  for (const json& piece : map[0]["pieces"]) names.push_back(piece["name"]);
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"Ada", "Ada", "Ben", "row 3"}));
  const auto layers = plate_layers_of(folder_, "p.layers.json");
  const double cone = 7 * std::sin(2 * M_PI / 7) / 2;
  // In the first section, 0.25 mm up.
  const double radius = 4 - 2 * 0.25 / 3;
  EXPECT_NEAR(area_of(layers[0]), 2 * 9 + 16 + cone * radius * radius, 1e-6);
  EXPECT_NEAR(map[0]["volume_mm3"].get<double>(),
              2 * 54 + 128 + cone * (16 + 8 + 4), 0.1);
}

TEST_F(PlateCommand, EqualOrdersAreOnePiece) {
  folder_.write("echo.scad", "n = 1;\necho(n);\ncube(4);\n");
  folder_.write("t.csv", "name,quantity,n\nAda,2,1\nBen,1,2\nAda again,3,1\n");
  const auto result = plate(
      {"echo.scad", "--table", "t.csv", "-o", "p.slc", "--map", "map.html"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(count(result.errors, "ECHO"), 2U) << result.errors;
  const std::string page = read_file(folder_.file("map.html"));
  EXPECT_TRUE(has(page, "<li>5 × Ada</li><li>1 × Ben</li>"));
}

TEST_F(PlateCommand, MaterialsLieOnDifferentPlates) {
  folder_.write("t.csv",
                "name,quantity,material\n"
                "Ada,2,bluecast-x10\n"
                "Ben,1,\n"
                "Eve,1,bluecast-x10\n");
  const json map = map_of({"cube.scad", "--table", "t.csv", "-o", "{plate}.slc",
                           "--material", "bluecast-x5"});
  ASSERT_EQ(map.size(), 2U);
  for (const json& plate : map) {
    for (const json& piece : plate["pieces"]) {
      EXPECT_EQ(piece["name"] == "Ben", plate["pieces"].size() == 1U);
    }
    EXPECT_GT(plate["grams"], 0);
  }
  EXPECT_TRUE(
      has(failure({"cube.scad", "--table", "t.csv", "-o", "one.slc"}, 2),
          "there are 2 plates"));
}

TEST_F(PlateCommand, TablesThatItCannotFollowAreRefused) {
  const auto message = [&](const std::string& table) {
    const std::string errors = failure_of_table(table);
    // The place of an error is the table's.
    EXPECT_TRUE(errors.starts_with("t.csv:2:1: error: ") ||
                errors.starts_with("error: "))
        << errors;
    return errors;
  };
  folder_.write("t.csv", "");
  EXPECT_TRUE(has(message(""), "'t.csv' has no rows below its header"));
  EXPECT_TRUE(has(message("design,size\n"), "'t.csv' has no rows below"));
  EXPECT_TRUE(has(message("design,sise\ncube.scad,3\n"),
                  "'cube.scad' has no variable 'sise'"));
  EXPECT_TRUE(has(message("design,quantity\ncube.scad,many\n"),
                  "quantity: a number of copies was expected, not 'many'"));
  EXPECT_TRUE(has(message("design,quantity\ncube.scad,-1\n"), "not '-1'"));
  EXPECT_TRUE(has(message("design,quantity\ncube.scad,1e9\n"), "not '1e9'"));
  EXPECT_TRUE(has(message("name,size\nAda,3\n"),
                  "the row names no design, and neither does the command "
                  "line"));
  EXPECT_TRUE(has(message("design,size\ncube.scad\n"),
                  "the row has 1 cells, the header has 2"));
  EXPECT_TRUE(has(message("design,size\ncube.scad,wide\n"),
                  "size: a number was expected, not 'wide'"));
  EXPECT_TRUE(has(message("design,quantity\ncube.scad,0\n"),
                  "'t.csv' orders nothing: all quantities are 0"));
  EXPECT_TRUE(has(failure_of_table("design\nnone.scad\n"), "none.scad"));
  EXPECT_TRUE(has(failure({"--table", "none.csv", "-o", "p.slc"}), "none.csv"));
}

// --- What does not fit ------------------------------------------------------

TEST_F(PlateCommand, SeveralPlatesNeedNumbers) {
  EXPECT_EQ(failure({"cube.scad", "--copies", "50", "-o", "p.slc"}, 2),
            "error: there are 2 plates: -o needs {plate}, as in "
            "'plate-{plate}.sl1'\n");
  const json map =
      map_of({"cube.scad", "--copies", "50", "-o", "p-{plate}.slc"});
  ASSERT_EQ(map.size(), 2U);
  EXPECT_EQ(map[0]["pieces"].size() + map[1]["pieces"].size(), 50U);
  EXPECT_EQ(map[1]["output"], "p-2.slc");
  EXPECT_FALSE(read_file(folder_.file("p-2.slc")).empty());
}

// A plate of one material is not written where another one's cannot be.
TEST_F(PlateCommand, APieceTooLargeEndsAll) {
  folder_.write("t.csv",
                "name,material,size\n"
                "Ada,bluecast-x5,5\n"
                "Ben,bluecast-x10,45\n"
                "Eve,bluecast-x10,4\n");
  EXPECT_EQ(failure({"cube.scad", "--table", "t.csv", "-o", "{plate}.slc"}),
            "error: Ben does not fit a plate of 60 x 40 mm\n");
  folder_.write("high.scad", "cube([3, 3, 400]);\n");
  EXPECT_TRUE(
      has(failure({"high.scad", "-o", "p.slc", "--printer", "elegoo-mars-4"}),
          "error: high is 400 mm high, the printer builds 175 mm\n"));
}

TEST_F(PlateCommand, ADesignThatFailsNamesItself) {
  folder_.write("bad.scad", "cube(3);\nassert(false, \"no\");\n");
  const std::string errors =
      failure({"cube.scad", "bad.scad", "cone.scad", "-o", "p.slc"});
  EXPECT_TRUE(errors.starts_with("bad: bad.scad:2:1: error: ")) << errors;
  folder_.write("flat.scad", "square(4);\n");
  EXPECT_TRUE(has(failure({"flat.scad", "-o", "p.layers.json"}),
                  "flat: error: The design is flat: plates take solids\n"));
  folder_.write("empty.scad",
                "intersection() { cube(1); translate([5, 0, 0]) cube(1); }\n");
  EXPECT_TRUE(has(failure({"empty.scad", "-o", "p.slc"}),
                  "empty: error: Current top level object is empty."));
}

// A name of a table may hold anything.
TEST_F(PlateCommand, ANameSpeaksForNoOther) {
  folder_.write("bad.scad", "assert(false);\n");
  folder_.write("t.csv", "name\n\"x\nAda: error: stolen\"\n");
  const std::string errors =
      failure({"bad.scad", "--table", "t.csv", "-o", "p.slc"});
  EXPECT_FALSE(has(errors, "\nAda")) << errors;
}

TEST_F(PlateCommand, StrictRunsRefuseAPieceThatWarns) {
  folder_.write("warns.scad", "cube(3);\nunknown();\n");
  const auto result = plate({"warns.scad", "-o", "w.slc"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors, "warns.scad:2:1: warning: ")) << result.errors;
  const std::string errors =
      failure({"cube.scad", "warns.scad", "-o", "p.slc", "--strict"});
  EXPECT_TRUE(has(errors, "warns: error: not written: 1 warning (first: "))
      << errors;
  // What is wrong with the printer, too.
  EXPECT_TRUE(has(failure({"cube.scad", "-o", "p.sl1", "--printer",
                           "elegoo-mars-4", "--strict"}),
                  "not written: "));
}

TEST_F(PlateCommand, FindingsAreThoseOfThePieces) {
  folder_.write("island.scad", "cube(3);\ntranslate([9, 0, 5]) cube(3);\n");
  const auto result =
      plate({"cube.scad", "island.scad", "--copies", "3", "-o", "p.slc"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(count(result.errors, "island: print: 1 loose part"), 1U)
      << result.errors;
  EXPECT_EQ(count(result.errors, "print:"), 1U) << result.errors;
  const std::string errors =
      failure({"cube.scad", "island.scad", "-o", "q.slc", "--fail-on", "all"});
  EXPECT_EQ(errors, "island: error: not written: 1 loose part (--fail-on)\n");
}

// --- Maps -------------------------------------------------------------------

TEST_F(PlateCommand, ThePageListsWhatLiesWhere) {
  folder_.write("t.csv", "name,quantity,size\n<b>&\"Ada\",3,4\nBen,40,5\n");
  const auto result = plate({"cube.scad", "--table", "t.csv", "-o",
                             "p-{plate}.slc", "--map", "maps/map.html"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::string page = read_file(folder_.file("maps/map.html"));
  EXPECT_FALSE(has(page, "<b>"));
  const std::string name = "&lt;b&gt;&amp;&quot;Ada&quot;";
  EXPECT_EQ(count(page, "<title>" + name + "</title>"), 3U);
  EXPECT_EQ(count(page, "<title>Ben</title>"), 40U);
  EXPECT_TRUE(has(page, "× " + name + "</li>"));
  EXPECT_EQ(count(page, "<h2>p-1.slc: "), 1U);
}

TEST_F(PlateCommand, TheMapSaysWhereALoopLies) {
  const json map = map_of({"ell.scad", "-o", "p.layers.json", "--copies", "2"});
  const auto layers = plate_layers_of(folder_, "p.layers.json");
  ASSERT_EQ(layers[0].loops.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const json& piece = map[0]["pieces"][i];
    EXPECT_EQ(piece["name"], "ell");
    const double angle = piece["turn_deg"].get<double>() * M_PI / 180;
    // The origin is a corner of it.
    const Vec2 corner(piece["x_mm"], piece["y_mm"]);
    const Vec2 other = corner + Vec2(9 * std::cos(angle), 9 * std::sin(angle));
    for (const Vec2 point : {corner, other}) {
      double nearest = 1e9;
      for (const Vec2 p : layers[0].loops[i]) {
        nearest = std::min(nearest, std::hypot(p.x - point.x, p.y - point.y));
      }
      EXPECT_LT(nearest, 1e-6);
    }
  }
}

// --- Options ----------------------------------------------------------------

TEST_F(PlateCommand, IsTheSameForAnyNumberOfThreads) {
  std::vector<std::string> bytes;
  for (const std::string threads : {"1", "4"}) {
    std::string all;
    ASSERT_EQ(plate({"cube.scad", "cone.scad", "ell.scad", "--copies", "12",
                     "--supports", "-o", "p-{plate}.slc", "--threads", threads,
                     "--map", "m.json"})
                  .status,
              0);
    for (const char* const name : {"p-1.slc", "p-2.slc", "m.json"}) {
      all += read_file(folder_.file(name));
    }
    bytes.push_back(std::move(all));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST_F(PlateCommand, TakesMeshesBesideDesigns) {
  const auto facet = [](const char* a, const char* b, const char* c) {
    return fmt::format(
        "facet normal 0 0 0\nouter loop\nvertex {}\nvertex {}\nvertex {}\n"
        "endloop\nendfacet\n",
        a, b, c);
  };
  folder_.write("wedge.stl", "solid w\n" + facet("0 0 0", "0 6 0", "6 0 0") +
                                 facet("0 0 0", "6 0 0", "0 0 6") +
                                 facet("0 0 0", "0 0 6", "0 6 0") +
                                 facet("6 0 0", "0 6 0", "0 0 6") +
                                 "endsolid w\n");
  folder_.write("t.csv", "design,quantity,size\nwedge.stl,2,\ncube.scad,1,4\n");
  const json map = map_of({"--table", "t.csv", "-o", "p.slc"});
  EXPECT_EQ(map[0]["pieces"].size(), 3U);
  EXPECT_NEAR(map[0]["volume_mm3"], 2 * 36 + 128, 1);
}

TEST_F(PlateCommand, SupportsAndCavitiesBelongToThePieces) {
  folder_.write("table.scad",
                "translate([0, 0, 6]) cube([9, 9, 3]); cube([3, 3, 7]);\n");
  const json plain = map_of({"table.scad", "--copies", "2", "-o", "p.slc"});
  const json held =
      map_of({"table.scad", "--copies", "2", "-o", "p.slc", "--supports"});
  EXPECT_GT(held[0]["volume_mm3"], plain[0]["volume_mm3"]);
  EXPECT_GT(held[0]["layers"], plain[0]["layers"]);
  folder_.write("box.scad", "cube([12, 12, 8]);\n");
  const json hollow = map_of({"box.scad", "--copies", "2", "-o", "p.slc",
                              "--hollow", "1", "--drain", "none"});
  EXPECT_NEAR(hollow[0]["volume_mm3"], 2 * (12 * 12 * 8 - 10 * 10 * 6), 1e-3);
}

TEST_F(PlateCommand, MistakesAreRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes =
      {
          {{"-o", "p.slc"}, "plate needs a design or --table"},
          {{"a.scad", "b.scad", "--table", "t.csv", "-o", "p.slc"},
           "with --table one design at most: that of rows without one"},
          {{"--table", "t.csv", "--copies", "2", "-o", "p.slc"},
           "--copies is the table's column 'quantity'"},
          {{"a.scad", "-o", "p.slc", "--heights", "1"},
           "plates have layers of one thickness"},
          {{"a.scad", "-o", "p.slc", "--adaptive", "0.02"},
           "plates have layers of one thickness"},
          {{"a.scad", "-o", "p.slc", "--map", "m.txt"},
           "--map writes .html or .json; 'm.txt' is neither"},
          {{"a.scad", "-o", "p.echo"}, "plates are layers; 'p.echo' is none"},
          {{"a.scad", "-o", "{name}.slc"},
           "'{name}' in -o: plates have {plate} alone"},
          {{"a.scad", "-o", "p.slc", "--report", "r.json"},
           "the report of plates is --map FILE.json"},
          {{"a.scad", "-o", "p.slc", "--layers", "1:3"},
           "plates have all layers: --layers cannot be"},
      };
  for (const auto& [words, message] : mistakes) {
    EXPECT_EQ(failure(words, 2), "lamina: " + message +
                                     "\nRun 'lamina --help' for the "
                                     "options.\n");
  }
  const auto bare = run(folder_, {"plate", "cube.scad", "-o", "p.slc"});
  EXPECT_EQ(bare.status, 2);
  EXPECT_TRUE(has(bare.errors,
                  "plate needs --printer, or the plate's size as --plate W,D"));
  for (const std::string size : {"60", "60,0", "x,3", "60,-1"}) {
    const auto result =
        run(folder_, {"plate", "cube.scad", "-o", "p.slc", "--plate", size});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(has(result.errors,
                    "--plate: a width and a depth were expected, such as "
                    "120,68, not '" +
                        size + "'"))
        << result.errors;
  }
  EXPECT_TRUE(has(
      failure({"cube.scad", "-o", "p.layers.json", "--map", "p.layers.json"},
              2),
      "-o and --map would both write 'p.layers.json'"));
  EXPECT_TRUE(has(run(folder_, {"plate", "cube.scad", "-o", "p.slc", "--plate",
                                "300,40", "--printer", "elegoo-mars-4"})
                      .errors,
                  "--plate 300,40 is larger than what Elegoo Mars 4 builds"));
}

// --- Labels -----------------------------------------------------------------

// The holes of a layer, counter-clockwise.
std::vector<Loop> holes_of(const PlateLayer& layer) {
  std::vector<Loop> holes;
  for (const Loop& loop : layer.loops) {
    if (area_of({0, {loop}}) > 0) continue;
    holes.emplace_back(loop.rbegin(), loop.rend());
  }
  return holes;
}

// Whether one loop is the other, turned by a quarter turn or not at all, and
// shifted; never mirrored.
bool is_moved(const Loop& a, const Loop& b) {
  if (a.size() != b.size()) return false;
  const auto edge = [](const Loop& loop, std::size_t i) {
    return loop[(i + 1) % loop.size()] - loop[i % loop.size()];
  };
  for (const bool is_turned : {false, true}) {
    for (std::size_t shift = 0; shift < a.size(); ++shift) {
      bool is_same = true;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec2 one = edge(a, i);
        const Vec2 turned = is_turned ? Vec2(-one.y, one.x) : one;
        const Vec2 off = turned - edge(b, i + shift);
        is_same = is_same && std::hypot(off.x, off.y) < 0.005;
      }
      if (is_same) return true;
    }
  }
  return false;
}

class PlateLabels : public PlateCommand {
 protected:
  // A plate of parts on rafts, in layers of 0.2 mm.
  std::vector<PlateLayer> labeled(std::vector<std::string> words) const {
    words.insert(words.begin(), "plate");
    words.insert(words.end(),
                 {"--plate", "150,120", "--layer", "0.2", "--turns", "1",
                  "--supports=medium,raft", "--label", "-o", "p.layers.json"});
    const auto result = run(folder_, words);
    EXPECT_EQ(result.status, 0) << result.errors;
    return plate_layers_of(folder_, "p.layers.json");
  }

  // What a text is by itself.
  std::vector<Loop> letters(const std::string& text) const {
    folder_.write("text.scad",
                  "linear_extrude(1) text(\"" + text + "\", size = 2.8);");
    EXPECT_EQ(run(folder_, {"text.scad", "--layer", "0.5", "-q", "-o",
                            "text.layers.json"})
                  .status,
              0);
    return plate_layers_of(folder_, "text.layers.json").front().loops;
  }

  static double area_of_loops(const std::vector<Loop>& loops) {
    return area_of({0, loops});
  }
};

TEST_F(PlateLabels, AreReadFromAboveInTheTopOfTheRaft) {
  folder_.write("L.scad", "cube([24, 18, 3]);");
  const auto layers = labeled({"L.scad"});
  const auto expected = letters("L");
  ASSERT_EQ(expected.size(), 1U);
  // The raft is 1 mm high, and the letters are 0.4 mm deep.
  for (std::size_t i = 0; i < 5; ++i) {
    const auto holes = holes_of(layers[i]);
    ASSERT_EQ(holes.size(), i < 3 ? 0U : 1U) << i;
    if (i < 3) continue;
    EXPECT_TRUE(is_moved(expected.front(), holes.front()));
    Loop mirrored = holes.front();
    for (Vec2& point : mirrored) point.x = -point.x;
    std::ranges::reverse(mirrored);
    EXPECT_FALSE(is_moved(expected.front(), mirrored));
  }
}

// Small letters are 2 mm high.
TEST_F(PlateLabels, AreLegible) {
  for (const Loop& loop : letters("xz")) {
    const auto [low, high] =
        std::ranges::minmax_element(loop, {}, [](Vec2 p) { return p.y; });
    EXPECT_GE(high->y - low->y, 2);
  }
}

// The raft gets a tab where a name is too long, and pieces stay apart.
TEST_F(PlateLabels, LongNamesLieOnATab) {
  folder_.write("a.scad", "cube([8, 8, 3]);");
  folder_.write(
      "t.csv", "design,name,quantity\na.scad,LITTLE LIFT FILE,2\na.scad,T,1\n");
  const auto layers = labeled({"--table", "t.csv"});
  EXPECT_NEAR(area_of_loops(holes_of(layers[4])),
              2 * area_of_loops(letters("LITTLE LIFT FILE")) +
                  area_of_loops(letters("T")),
              0.02);
  // One outline each: the tabs hang together with their rafts.
  EXPECT_EQ(layers[4].loops.size() - holes_of(layers[4]).size(), 3U);
  EXPECT_EQ(layers[0].loops.size(), 3U);
}

TEST_F(PlateLabels, NeedARaft) {
  for (const char* supports :
       {"--no-strict", "--supports", "--supports=heavy"}) {
    const std::string message =
        failure({"cube.scad", "--label", supports, "-o", "p.slc"}, 2);
    EXPECT_TRUE(has(message, "--label needs a raft: --supports=medium,raft"))
        << message;
  }
}

}  // namespace
}  // namespace lamina::cli
