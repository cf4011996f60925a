// Layers read back from every format: what lamina writes, what other programs
// write as docs/formats.md describes it, and what is broken.

#include "slicer/formats/layer_reader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "base/diagnostic.h"
#include "base/file/zip.h"
#include "tests/base/file/zip_writer.h"
#include "tests/slicer/formats/writing.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using namespace std::string_literals;
using support::TemporaryFolder;

struct Content {
  LayerFileFacts facts;
  std::vector<Layer> layers;
};

Content read(const std::string& name, const std::string& bytes) {
  // In memory: there are thousands of files.
  static const TemporaryFolder folder("/dev/shm");
  Content content;
  content.facts =
      read_layers(folder.write(name, bytes),
                  [&](const Layer& layer) { content.layers.push_back(layer); });
  return content;
}

// The words of the error behind the file's name; empty: none.
std::string error_of(const std::string& name, const std::string& bytes) {
  try {
    read(name, bytes);
  } catch (const FileError& error) {
    const std::string words = error.what();
    return words.substr(words.find(name) + name.size() + 2);
  }
  return {};
}

std::vector<std::vector<Vec2>> loops(const Layer& layer) {
  std::vector<std::vector<Vec2>> result;
  for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
    const auto loop = layer.contours.loop(i);
    result.emplace_back(loop.begin(), loop.end());
  }
  return result;
}

// Whether all numbers are within the reach of a reader, and the loops end one
// behind the other, the last with the last point.
bool is_sound(const Layer& layer) {
  const auto is_within_reach = [](double value) {
    return std::abs(value) <= 1e9;  // false for what is not a number
  };
  const plane::Contours& contours = layer.contours;
  return is_within_reach(layer.bottom) && is_within_reach(layer.top) &&
         is_within_reach(layer.section_z) &&
         std::ranges::all_of(contours.points,
                             [&](Vec2 point) {
                               return is_within_reach(point.x) &&
                                      is_within_reach(point.y);
                             }) &&
         std::ranges::is_sorted(contours.ends) &&
         (contours.ends.empty() ? 0 : contours.ends.back()) ==
             contours.points.size();
}

struct Written {
  std::string name;
  std::string bytes;
  LayerFileFacts facts;
};

// The three layers in every format.
std::vector<Written> files() {
  const std::vector<Layer> layers = three_layers();
  std::vector<Written> files;
  const auto add = [&](const std::string& name, const WriterOptions& options,
                       const std::string& format, bool is_float32) {
    files.push_back({name, written(layers, options), {}});
    files.back().facts.format = format;
    files.back().facts.is_float32 = is_float32;
  };
  using enum OutputFormat;
  add("a.slc", {.format = kSlc}, "SLC 2.0", true);
  add("binary.cli", {.format = kCli}, "CLI, binary", true);
  add("ascii.CLI", {.format = kCli, .cli = CliEncoding::kAscii}, "CLI, ASCII",
      true);
  add("a.svg", {.format = kSvg}, "SVG", true);
  add("a.3mf", {.format = kThreemf}, "3MF with slices", true);
  add("a.layers.json", {.format = kLayersJson}, "layers.json", false);
  return files;
}

TEST(ReadLayers, GivesBackWhatWasWritten) {
  const std::vector<Layer> layers = three_layers();
  for (const Written& file : files()) {
    SCOPED_TRACE(file.name);
    const Content content = read(file.name, file.bytes);
    EXPECT_EQ(content.facts.format, file.facts.format);
    EXPECT_EQ(content.facts.is_float32, file.facts.is_float32);
    ASSERT_EQ(content.layers.size(), layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
      EXPECT_EQ(content.layers[i].section_z, layers[i].section_z);
      EXPECT_EQ(content.layers[i].bottom, layers[i].bottom);
      EXPECT_EQ(content.layers[i].top, layers[i].top);
      EXPECT_EQ(loops(content.layers[i]), loops(layers[i]));
    }
  }
}

// Command, three numbers and four points. Without it a binary CLI file is
// whole, as nothing counts the loops of a layer.
constexpr std::size_t kLastPolyline = 2 + 3 * 4 + 4 * 8;

TEST(ReadLayers, ACutFileIsAnErrorWhereverItIsCut) {
  for (const Written& file : files()) {
    SCOPED_TRACE(file.name);
    // What only ends the last line may be missing.
    const std::size_t whole = file.bytes.find_last_not_of('\n') + 1;
    for (std::size_t size = 0; size < whole; ++size) {
      if (file.name == "binary.cli" && size == whole - kLastPolyline) continue;
      // Where the directory stands, and how long a comment is, ends archives:
      // minizip finds the directory by itself.
      if (file.name == "a.3mf" && size + 6 >= whole) continue;
      ASSERT_NE(error_of(file.name, file.bytes.substr(0, size)), "")
          << size << " of " << whole << " bytes";
    }
  }
}

TEST(ReadLayers, DamagedFilesAreErrorsOrGiveSoundLayers) {
  std::mt19937 random(20260801);
  for (const Written& file : files()) {
    SCOPED_TRACE(file.name);
    int refused = 0;
    int read_all_the_same = 0;
    for (int run = 0; run < 1000; ++run) {
      std::string bytes = file.bytes;
      const auto changes = 1 + random() % 4;
      for (std::size_t i = 0; i < changes; ++i) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      try {
        for (const Layer& layer : read(file.name, bytes).layers) {
          ASSERT_TRUE(is_sound(layer)) << "run " << run;
        }
        ++read_all_the_same;
      } catch (const FileError& error) {
        ASSERT_NE(std::string(error.what()).find(file.name), std::string::npos);
        ++refused;
      }
    }
    EXPECT_GT(refused, 50);
    EXPECT_GT(read_all_the_same, 20);
  }
}

TEST(ReadLayers, RefusesOtherNames) {
  EXPECT_FALSE(is_readable_layer_file("ring.stl"));
  EXPECT_FALSE(is_readable_layer_file("ring.json"));
  EXPECT_FALSE(is_readable_layer_file(".slc"));
  EXPECT_TRUE(is_readable_layer_file("out/ring.Layers.Json"));
  EXPECT_NE(error_of("ring.stl", "solid ring"), "");
}

TEST(ReadLayers, AMissingFileIsAnError) {
  for (const char* name : {"no.slc", "no.cli", "no.svg", "no.layers.json"}) {
    EXPECT_THROW(read_layers(name, [](const Layer&) {}), FileError);
  }
}

TEST(ReadLayers, RefusesWhatLiesTooFarAway) {
  EXPECT_EQ(
      error_of("a.layers.json", R"({"layers":[{"z":1,"contours":[{"points":[)"
                                "[0,0],[2e9,0],[0,1]]}]}]}"),
      "layer 1 reaches farther than 1e+09 mm from the origin");
}

// In every format: a layer without loops, then one with a loop of two points.
TEST(ReadLayers, NotesLoopsThatAreTooShort) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.cli",
       "$$HEADERSTART\n$$ASCII\n$$UNITS/2\n$$HEADEREND\n"
       "$$GEOMETRYSTART\n$$LAYER/1\n$$LAYER/2\n"
       "$$POLYLINE/1,1,3,1,2,3,2,1,2\n$$GEOMETRYEND\n"},
      {"a.svg",
       "<svg><!-- Slic3r --><g slic3r:z=\"1\"/><g slic3r:z=\"2\">"
       "<polygon slic3r:type=\"contour\" points=\"2,4 6,4\"/></g>"
       "</svg>"},
      {"a.3mf",
       csg::make_zip(
           {{"3D/3dmodel.model",
             "<model><resources><s:slicestack><s:slice ztop=\"1\"/>"
             "<s:slice ztop=\"2\"><s:vertices><s:vertex x=\"2\" y=\"4\"/>"
             "<s:vertex x=\"6\" y=\"4\"/></s:vertices><s:polygon "
             "startv=\"0\"><s:segment v2=\"1\"/><s:segment v2=\"0\"/>"
             "</s:polygon></s:slice></s:slicestack></resources></model>"}})},
      {"a.layers.json", R"({"layers":[{"z":1},{"z":2,"contours":[)"
                        R"({"points":[[2,4],[6,4]]}]}]})"}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    const Content content = read(name, bytes);
    EXPECT_EQ(content.facts.short_loops.count, 1U);
    EXPECT_EQ(content.facts.short_loops.layer, 2U);
    EXPECT_EQ(content.facts.short_loops.place, Vec2(2, 4));
    EXPECT_EQ(content.facts.open_loops.count, 0U);
    EXPECT_EQ(left_out_text(content.facts), "1 loop of fewer than 3 points");
    EXPECT_TRUE(content.layers.at(1).contours.is_empty());
  }
}

// --- CLI --------------------------------------------------------------------

const std::string kAsciiHead =
    "$$HEADERSTART\n$$ASCII\n$$UNITS/0.005\n$$VERSION/200\n"
    "$$LABEL/1,ring\n$$HEADEREND\n$$GEOMETRYSTART\n";

std::string ascii(const std::string& body) {
  return kAsciiHead + body + "$$GEOMETRYEND\n";
}

TEST(ReadCli, ReadsAsciiInUnitsWithCommentsAndLinesBroken) {
  const Content content = read(
      "a.cli", ascii("// first // $$LAYER/100.0 $$POLYLINE/1,1,4,\n0,0, 200,0 "
                     ",\r\n +200,200,0,0\n$$LAYER/120\n"
                     "$$HATCHES/1,1,0,0,1,1$$POLYLINE/1,2,2,0,0,5,5\n"));
  EXPECT_EQ(left_out_text(content.facts), "1 hatch block, 1 open polyline");
  ASSERT_EQ(content.layers.size(), 2U);
  // As thick as the second one.
  EXPECT_DOUBLE_EQ(content.layers[0].bottom, 0.4);
  EXPECT_DOUBLE_EQ(content.layers[0].section_z, 0.45);
  EXPECT_DOUBLE_EQ(content.layers[1].top, 0.6);
  EXPECT_EQ(loops(content.layers[0]),
            (std::vector<std::vector<Vec2>>{{{0, 0}, {1, 0}, {1, 1}}}));
  EXPECT_TRUE(content.layers[1].contours.is_empty());
}

TEST(ReadCli, TurnsLoopsAsTheirDirectionSays) {
  const Content content =
      read("a.cli", ascii("$$LAYER/1$$POLYLINE/1,0,4,0,0,200,0,0,200,0,0"));
  EXPECT_EQ(loops(content.layers.at(0)),
            (std::vector<std::vector<Vec2>>{{{0, 1}, {1, 0}, {0, 0}}}));
}

TEST(ReadCli, ReadsShortNumbers) {
  const std::string file =
      "$$HEADERSTART\n$$BINARY\n$$UNITS/0.5\n$$VERSION/200\n$$HEADEREND"
      "\x80\x00\x04\x00"
      "\x81\x00\x01\x00\x01\x00\x04\x00"
      "\x00\x00\x00\x00\x02\x00\x00\x00\x02\x00\x02\x00\x00\x00\x00\x00"
      "\x83\x00\x01\x00\x01\x00\x00\x00\x00\x00\x02\x00\x00\x00"s;
  const Content content = read("a.cli", file);
  ASSERT_EQ(content.layers.size(), 1U);
  EXPECT_EQ(left_out_text(content.facts), "1 hatch block");
  EXPECT_EQ(content.layers[0].top, 2);
  EXPECT_EQ(loops(content.layers[0]),
            (std::vector<std::vector<Vec2>>{{{0, 0}, {1, 0}, {1, 1}}}));
}

// Each command and the header are filled up to four bytes.
TEST(ReadCli, ReadsAlignedNumbers) {
  const std::string head = "$$HEADERSTART\n$$BINARY\n$$UNITS/1\n$$ALIGN\n";
  for (const std::string blanks : {"", " ", "  ", "   "}) {
    std::string file = head + blanks + "$$HEADEREND";
    file.resize((file.size() + 3) / 4 * 4);
    file +=
        "\x7F\x00\x00\x00\x00\x00\x00\x40"  // a layer at 2
        "\x82\x00\x00\x00\x01\x00\x00\x00\x01\x00\x00\x00\x04\x00\x00\x00"
        "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x40\x00\x00\x00\x00"
        "\x00\x00\x00\x40\x00\x00\x00\x40\x00\x00\x00\x00\x00\x00\x00\x00"s;
    const Content content = read("a.cli", file);
    ASSERT_EQ(content.layers.size(), 1U);
    EXPECT_EQ(content.layers[0].top, 2);
    EXPECT_EQ(loops(content.layers[0]),
              (std::vector<std::vector<Vec2>>{{{0, 0}, {2, 0}, {2, 2}}}));
  }
  std::string file = head + "$$HEADEREND";
  file.resize((file.size() + 3) / 4 * 4);
  EXPECT_EQ(error_of("a.cli", file + "\x80\x00\x00\x00\x04\x00\x00\x00"s),
            fmt::format("byte {}: command 128 is not supported in an aligned "
                        "file ($$ALIGN)",
                        file.size() + 2));
}

TEST(ReadCli, SectionsWithoutThicknessAreAtTheirHeights) {
  Layer low = layer_at(1, 1, {{{0, 0}, {1, 0}, {1, 1}}});
  Layer high = layer_at(4, 4, {{{0, 0}, {1, 0}, {1, 1}}});
  const Content content =
      read("a.cli", written({low, high}, {.format = OutputFormat::kCli}));
  ASSERT_EQ(content.layers.size(), 2U);
  EXPECT_EQ(content.layers[0].section_z, 1);
  EXPECT_EQ(content.layers[1].section_z, 4);
}

TEST(ReadCli, NamesThePlaceOfAFault) {
  EXPECT_EQ(error_of("a.cli", "solid"),
            "not a CLI file: it does not begin with \"$$HEADERSTART\"");
  EXPECT_EQ(error_of("a.cli", "$$HEADERSTART\n$$HEADEREND"),
            "the header has neither $$ASCII nor $$BINARY");
  EXPECT_EQ(error_of("a.cli", ascii("$$LAYER/1\n$$POLYLINE/1,7,0\n")),
            "line 9: direction 7 (0, 1 or 2 was expected)");
  EXPECT_EQ(error_of("a.cli", ascii("$$POLYLINE/1,1,0\n")),
            "line 8: a polyline stands before any layer");
  EXPECT_EQ(error_of("a.cli", ascii("$$LAYER/x\n")),
            "line 8: a number was expected");
  EXPECT_EQ(error_of("a.cli", ascii("$$LAYER/1\n$$POLYLINE/1,1,3,0,0\n")),
            "line 10: ',' and a number were expected");
  EXPECT_EQ(error_of("a.cli", ascii("$$LAYER/1\n$$POLYLINE/1,1,-3\n")),
            "line 9: -3 points");
  EXPECT_EQ(error_of("a.cli", ascii("$$WARM/1\n")),
            "line 8: unknown command '$$WARM'");
  const std::string binary = "$$HEADERSTART\n$$BINARY\n$$UNITS/1\n$$HEADEREND";
  EXPECT_EQ(error_of("a.cli", binary + "\x09\x00"s),
            "byte 46: command 9 stands before any layer");
  EXPECT_EQ(
      error_of("a.cli", binary + "\x80\x00\x04\x00\x81\x00\x01\x00\x01\x00"
                                 "\xFF\xFF\x00"s),
      "the file ends at byte 57, 262139 bytes early");
}

TEST(ReadCli, CountsLoopsThatAreOpen) {
  const Content content =
      read("a.cli", ascii("$$LAYER/1$$POLYLINE/1,1,3,0,0,200,0,200,200"
                          "$$POLYLINE/1,1,4,0,0,9,0,9,9,0,0"));
  EXPECT_EQ(content.facts.open_loops.count, 1U);
  EXPECT_EQ(content.facts.open_loops.layer, 1U);
  EXPECT_EQ(content.layers.at(0).contours.loop_count(), 2U);
}

TEST(ReadCli, NothingStandsBehindTheEnd) {
  const std::string whole = ascii("$$LAYER/1\n");
  EXPECT_EQ(error_of("a.cli", whole + " \r\n// end //\n\0\0\x1A"s), "");
  EXPECT_EQ(error_of("a.cli", whole + "$$LAYER/9\n"),
            "line 10: something stands behind $$GEOMETRYEND");
  EXPECT_EQ(error_of("a.cli", whole + whole),
            "line 10: something stands behind $$GEOMETRYEND");
}

// --- SVG --------------------------------------------------------------------

std::string slic3r_svg(const std::string& body) {
  return "<?xml version=\"1.0\"?>\n<svg width=\"10\" height=\"8\" "
         "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\">\n"
         "  <!-- \n  Generated using Slic3r 1.3.0\n -->\n" +
         body + "</svg>\n";
}

TEST(ReadSvg, ReadsWhatSlic3rWrites) {
  const Content content = read(
      "a.svg",
      slic3r_svg("<g id=\"layer0\" slic3r:z=\"2.5e-07\">"
                 "<polygon slic3r:type=\"contour\" points=\"10,8 0,8 0,0 "
                 "10,0\"/><polygon slic3r:type=\"hole\" points=\"2,1 2,3 5,3 "
                 "5,1\"/></g><g id=\"layer1\" slic3r:z=\"7.5e-07\"></g>"));
  EXPECT_EQ(content.facts.writer, "Slic3r 1.3.0");
  EXPECT_FALSE(content.facts.has_sides);
  ASSERT_EQ(content.layers.size(), 2U);
  EXPECT_DOUBLE_EQ(content.layers[0].section_z, 0.25);
  EXPECT_NEAR(content.layers[0].bottom, 0, 1e-12);
  EXPECT_DOUBLE_EQ(content.layers[1].top, 1);
  EXPECT_EQ(loops(content.layers[0]),
            (std::vector<std::vector<Vec2>>{{{10, 8}, {0, 8}, {0, 0}, {10, 0}},
                                            {{2, 1}, {2, 3}, {5, 3}, {5, 1}}}));
}

TEST(ReadSvg, KeepsToTheSizeThatTheHeadTells) {
  const Content content =
      read("a.svg",
           "<svg width=\"1in\" height=\"2in\" viewBox=\"0 0 10 20\">"
           "<g slic3r:z=\"1\"><polygon slic3r:type=\"contour\" "
           "points=\"0 0,10 0,10 10\"/></g></svg>");
  EXPECT_EQ(
      loops(content.layers.at(0)),
      (std::vector<std::vector<Vec2>>{{{25.4, -25.4}, {25.4, 0}, {0, 0}}}));
}

TEST(ReadSvg, CountsWhatItLeavesOutByItsKind) {
  const Content content = read(
      "a.svg", slic3r_svg("<g slic3r:z=\"1\"><path d=\"M5 5 L 6 5 z\"/>"
                          "<circle r=\"1\"/><circle r=\"2\"/>"
                          "<polygon slic3r:type=\"raft\"/>"
                          "<g><polygon slic3r:type=\"contour\"/></g></g>"));
  EXPECT_EQ(left_out_text(content.facts),
            "2 circle elements, 1 g element, 1 path element, 1 raft polygon");
  EXPECT_EQ(left_out_text({}), "");
}

TEST(ReadSvg, CountsWhatStandsBesideTheLayers) {
  const Content content = read(
      "a.svg", slic3r_svg("<title>ring</title><defs><path/></defs>"
                          "<sodipodi:namedview/><g slic3r:z=\"1\"/>"
                          "<g><path/></g><polygon slic3r:type=\"contour\"/>"));
  EXPECT_EQ(content.layers.size(), 1U);
  EXPECT_EQ(left_out_text(content.facts), "1 g element, 1 polygon element");
}

// Allocations of pugixml until one fails; none fails at 0.
std::size_t until_failure = 0;

void* allocate(std::size_t size) {
  const bool fails = until_failure > 0 && --until_failure == 0;
  return fails ? nullptr : std::malloc(size);
}

TEST(ReadSvg, LackOfMemoryIsNoFaultOfTheFile) {
  std::string body;
  for (int i = 0; i < 2000; ++i) {
    body += fmt::format("<g slic3r:z=\"{}\"></g>", i);
  }
  const std::string bytes = slic3r_svg(body);
  const auto usual = pugi::get_memory_allocation_function();
  pugi::set_memory_management_functions(
      allocate, pugi::get_memory_deallocation_function());
  for (std::size_t i : {1, 2, 3}) {
    until_failure = i;
    EXPECT_THROW(read("a.svg", bytes), std::bad_alloc) << i;
  }
  until_failure = 0;
  EXPECT_EQ(read("a.svg", bytes).layers.size(), 2000U);
  pugi::set_memory_management_functions(
      usual, pugi::get_memory_deallocation_function());
}

TEST(ReadSvg, NamesThePlaceOfAFault) {
  EXPECT_EQ(error_of("a.svg", "<svg>\n<g></svg>"),
            "line 2: Start-end tags mismatch");
  EXPECT_EQ(error_of("a.svg", "<html/>"),
            "not an SVG file: it has no element <svg>");
  EXPECT_EQ(error_of("a.svg", "<svg><g><path d=\"\"/></g></svg>"),
            "no layers: no group has slic3r:z, as Slic3r writes them");
  EXPECT_EQ(error_of("a.svg", "<svg>\n<g slic3r:z=\"high\"/></svg>"),
            "line 2: slic3r:z is not a number");
  EXPECT_EQ(error_of("a.svg",
                     "<svg><g slic3r:z=\"0\"/>\n<g><g>\n"
                     "<g slic3r:z=\"1\"/></g></g></svg>"),
            "line 3: a layer within another element is not supported");
  EXPECT_EQ(error_of("a.svg",
                     "<svg><g slic3r:z=\"0\">\n\n<polygon "
                     "points=\"0,0\"/></g></svg>"),
            "line 3: a polygon without slic3r:type");
  EXPECT_EQ(error_of("a.svg",
                     "<svg><g slic3r:z=\"0\">\n<polygon slic3r:type="
                     "\"contour\" points=\"5,0 6,0 6,1\" "
                     "transform=\"translate(5,5)\"/></g></svg>"),
            "line 2: a transform within a layer is not supported");
  EXPECT_EQ(error_of("a.svg",
                     "<svg><g slic3r:z=\"0\"><polygon slic3r:type="
                     "\"hole\" points=\"0,0 1,x\"/></g></svg>"),
            "line 1: number 4 of the points is malformed");
}

// --- 3MF --------------------------------------------------------------------

std::string threemf(const std::string& stack) {
  return csg::make_zip(
      {{"3D/3dmodel.model",
        "<model><resources><s:slicestack id=\"1\" zbottom=\"0\">" + stack +
            "</s:slicestack></resources></model>"}});
}

std::string slice(const std::string& segments) {
  return "<s:slice ztop=\"1\"><s:vertices><s:vertex x=\"0\" y=\"0\"/>"
         "<s:vertex x=\"5\" y=\"0\"/><s:vertex x=\"5\" y=\"5\"/>"
         "</s:vertices><s:polygon startv=\"0\">" +
         segments + "</s:polygon></s:slice>";
}

const std::string kTwoSegments = "<s:segment v2=\"1\"/><s:segment v2=\"2\"/>";

TEST(ReadThreemf, CountsLoopsThatAreOpen) {
  const auto open_loops = [](const std::string& segments) {
    return read("a.3mf", threemf(slice(segments))).facts.open_loops.count;
  };
  EXPECT_EQ(open_loops(kTwoSegments + "<s:segment v2=\"0\"/>"), 0U);
  EXPECT_EQ(open_loops(kTwoSegments), 1U);
}

TEST(ReadThreemf, RefusesSlicesInOtherParts) {
  const std::string reference =
      "<s:sliceref slicestackid=\"3\" slicepath=\"/2D/a.model\"/>";
  for (const std::string& stack :
       {reference, slice(kTwoSegments) + reference}) {
    EXPECT_EQ(error_of("a.3mf", threemf(stack)),
              "slices in other parts of the package (sliceref) are not "
              "supported");
  }
  EXPECT_EQ(error_of("a.3mf", threemf("")), "it holds no layers");
}

// --- Archives of images -----------------------------------------------------

using Entries = std::vector<std::pair<std::string, std::string>>;

// An archive of three images.
Entries image_archive(OutputFormat format) {
  WriterOptions options = {.format = format,
                           .printer = find_printer("prusa-sl1")};
  const std::string bytes = written(three_layers(), options);
  const ZipArchive archive = ZipArchive::open(bytes);
  Entries entries;
  for (const std::string& name : archive.names()) {
    entries.emplace_back(name, archive.read(name).value());
  }
  return entries;
}

Entries without(Entries entries, std::string_view name) {
  std::erase_if(entries,
                [&](const auto& entry) { return entry.first == name; });
  return entries;
}

// Adds to a text of the archive, or puts one into it.
Entries with(Entries entries, const std::string& name,
             const std::string& bytes) {
  for (auto& [known, text] : entries) {
    if (known == name) {
      text += bytes;
      return entries;
    }
  }
  entries.emplace_back(name, bytes);
  return entries;
}

TEST(ReadImages, AMissingImageIsAnError) {
  const Entries sl1 = image_archive(OutputFormat::kSl1);
  const auto error = [](const Entries& entries) {
    return error_of("a.sl1", csg::make_zip(entries));
  };
  EXPECT_EQ(error(sl1), "");
  EXPECT_EQ(error(without(sl1, "layers00001.png")),
            "the image before layers00002.png is missing");
  for (const char* const name : {"layers00000.png", "layers00002.png"}) {
    EXPECT_EQ(error(without(sl1, name)),
              "config.ini counts 3 layers, there are 2 images");
  }
  // PrusaSlicer counts slow layers apart.
  EXPECT_EQ(error(with(without(sl1, "config.ini"), "config.ini",
                       "layerHeight = 0.5\nnumFade = 10\nnumFast = 1\n"
                       "numSlow = 2\n")),
            "");
}

TEST(ReadImages, AMissingImageOfNanoDlpIsAnError) {
  const Entries plate = image_archive(OutputFormat::kNanoDlp);
  const auto error = [](const Entries& entries) {
    return error_of("a.zip", csg::make_zip(entries));
  };
  EXPECT_EQ(error(plate), "");
  EXPECT_EQ(error(without(plate, "1.png")),
            "the image before 2.png is missing");
  EXPECT_EQ(error(without(plate, "2.png")),
            "the image before 3.png is missing");
  EXPECT_EQ(error(without(plate, "3.png")),
            "plate.json counts 3 layers, there are 2 images");
  EXPECT_EQ(error(without(without(plate, "3.png"), "plate.json")), "");
}

TEST(ReadImages, PicturesOfTheWholeAreNoLayers) {
  const Entries sl1 = image_archive(OutputFormat::kSl1);
  EXPECT_EQ(
      read("a.sl1", csg::make_zip(with(sl1, "more/9.png", ""))).layers.size(),
      3U);
  Entries plate = image_archive(OutputFormat::kNanoDlp);
  for (const char* const name : {"3d.png", "preview.png", "more/9.png"}) {
    plate = with(plate, name, "");
  }
  EXPECT_EQ(read("a.zip", csg::make_zip(plate)).layers.size(), 3U);
}

// --- .layers.json -----------------------------------------------------------

TEST(ReadLayersJson, PassesOverWhatItDoesNotKnow) {
  const Content content = read(
      "a.layers.json",
      R"({"by":{"layers":[1,[2]]},"layers":[{"z":0.5,"note":null,"contours":[)"
      R"({"points":[[0,0],[0,1],[1,0]],"hole":false,"ends":[7]}]}]})");
  ASSERT_EQ(content.layers.size(), 1U);
  EXPECT_EQ(content.layers[0].top, 0.5);
  EXPECT_EQ(loops(content.layers[0]),
            (std::vector<std::vector<Vec2>>{{{1, 0}, {0, 1}, {0, 0}}}));
}

TEST(ReadLayersJson, NamesThePlaceOfAFault) {
  const auto error = [](const std::string& text) {
    return error_of("a.layers.json", text);
  };
  EXPECT_NE(error("{\"layers\":\n[}").find("line 2: not JSON near"),
            std::string::npos);
  EXPECT_EQ(error("[1]"), "line 1: an object with \"layers\" was expected");
  EXPECT_EQ(error("{}"), "it has no list \"layers\"");
  EXPECT_EQ(error("{\"units\":\"inch\"}"),
            "line 1: unknown unit 'inch' (mm was expected)");
  EXPECT_EQ(error("{\"units\":25.4}"), "line 1: \"units\" must be a text");
  EXPECT_EQ(error("{\"layers\":\n[{\"contours\":[]}]}"),
            "line 2: layer 1 has no z");
  EXPECT_EQ(error("{\"layers\":[{\"z\":true}]}"),
            "line 1: a height must be a number");
  EXPECT_EQ(error("{\"layers\":[{\"z\":0,\"contours\":[{\"points\":[\n[1]"),
            "line 2: a point needs two numbers");
  EXPECT_EQ(error("{\"layers\":[{\"z\":0,\"contours\":[{\"points\":[[1,2,3]"),
            "line 1: a point (two numbers) was expected");
  EXPECT_EQ(error("{\"layers\":[{\"z\":0,\"contours\":7"),
            "line 1: \"contours\" must be a list");
}

}  // namespace
}  // namespace lamina::slicer
