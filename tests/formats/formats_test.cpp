// Every format that the writers make, read back by a program that knows it
// from its description alone (read_layers.py), tells the layers that the exact
// numbers of .layers.json tell; and slic3r, which cuts the mesh that openscad
// makes of the same design, tells them too.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/openscad_cache.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

using support::ProcessResult;
using support::run_process;
using support::TemporaryFolder;

const std::string kSource = LAMINA_SOURCE;

struct LayerFacts {
  double height = 0;  // of the upper side; in SVG of the section
  int loops = 0;
  int holes = 0;
  double area = 0;
  double perimeter = 0;
};

std::string must_run(const std::vector<std::string>& arguments) {
  const ProcessResult result = run_process(arguments);
  if (result.status != 0) {
    throw std::runtime_error(arguments[0] + " fails: " + result.errors);
  }
  return result.output;
}

std::vector<LayerFacts> read_independently(
    const std::string& path, const std::string& reader = "read_layers.py") {
  std::istringstream lines(must_run(
      {"/usr/bin/python3", kSource + "/tests/formats/" + reader, path}));
  std::vector<LayerFacts> layers;
  LayerFacts layer;
  while (lines >> layer.height >> layer.loops >> layer.holes >> layer.area >>
         layer.perimeter) {
    layers.push_back(layer);
  }
  return layers;
}

using Loop = std::vector<std::vector<double>>;

void add_loop(const Loop& loop, LayerFacts& facts) {
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto& a = loop[i];
    const auto& b = loop[(i + 1) % loop.size()];
    area += ((a[0] - loop[0][0]) * (b[1] - loop[0][1]) -
             (a[1] - loop[0][1]) * (b[0] - loop[0][0])) /
            2;
    facts.perimeter += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  ++facts.loops;
  if (area < 0) ++facts.holes;
  facts.area += area;
}

std::vector<LayerFacts> read_json(const std::string& path) {
  const auto file = nlohmann::json::parse(std::ifstream(path));
  std::vector<LayerFacts> layers;
  for (const auto& layer : file.at("layers")) {
    LayerFacts facts;
    facts.height = layer.at("top").get<double>();
    for (const auto& contour : layer.at("contours")) {
      add_loop(contour.at("points").get<Loop>(), facts);
    }
    layers.push_back(facts);
  }
  return layers;
}

std::string design_path(const std::string& name) {
  return kSource + "/examples/" + name + ".scad";
}

// Layers of a design, with all vertices; 0.1 mm unless the options say so.
// Of images, a folder: without its '/' it would be a picture.
std::string output_of(const std::string& path) {
  return path.ends_with(".png") ? path + "/" : path;
}

std::string slice(const std::string& name, const TemporaryFolder& folder,
                  const std::string& ending,
                  const std::vector<std::string>& options = {}) {
  const std::string path = folder.file("layers" + ending);
  std::vector<std::string> arguments = {
      LAMINA_PROGRAM, design_path(name), "-o", output_of(path),
      "-q",           "--tolerance",     "0"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  if (std::find(options.begin(), options.end(), "--layer") == options.end()) {
    arguments.insert(arguments.end(), {"--layer", "0.1"});
  }
  must_run(arguments);
  return path;
}

void expect_same_layers(std::span<const LayerFacts> found,
                        std::span<const LayerFacts> expected,
                        double area_per_perimeter) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].loops, expected[i].loops) << "layer " << i;
    EXPECT_EQ(found[i].holes, expected[i].holes) << "layer " << i;
    EXPECT_NEAR(found[i].area, expected[i].area,
                area_per_perimeter * expected[i].perimeter)
        << "layer " << i;
  }
}

class Formats : public testing::TestWithParam<const char*> {};

TEST_P(Formats, TellTheSameLayers) {
  const TemporaryFolder folder;
  const std::vector<LayerFacts> expected =
      read_json(slice(GetParam(), folder, ".layers.json"));
  ASSERT_GT(expected.size(), 10U);
  struct Format {
    std::string ending;
    std::vector<std::string> options;
    double height;  // of a layer's number above its upper side
  };
  const Format formats[] = {{".slc", {}, 0},
                            {".cli", {"--cli", "binary"}, 0},
                            {".cli", {"--cli", "ascii"}, 0},
                            {".svg", {}, -0.05},
                            {".slices.3mf", {}, 0}};
  for (const Format& format : formats) {
    SCOPED_TRACE(format.ending);
    const std::vector<LayerFacts> found = read_independently(
        slice(GetParam(), folder, format.ending, format.options));
    // Numbers of 32 bits, of coordinates below 32 mm: 1e-6 mm.
    expect_same_layers(found, expected, 1e-6);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].height, expected[i].height + format.height, 2e-6);
    }
  }
}

TEST_P(Formats, Lib3mfReadsTheSameSlices) {
  const TemporaryFolder folder;
  const std::vector<LayerFacts> expected =
      read_json(slice(GetParam(), folder, ".layers.json"));
  const std::vector<LayerFacts> found = read_independently(
      slice(GetParam(), folder, ".slices.3mf"), "read_by_lib3mf.py");
  expect_same_layers(found, expected, 1e-6);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].height, expected[i].height, 2e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, Formats,
                         testing::Values("hoop", "solitaire", "signet",
                                         "pendant", "filigree"),
                         [](const auto& design) {
                           return std::string(design.param);
                         });

// Grey is the covered share of a pixel, rounded to 1/255 of it: the area of a
// layer is off by half of that, at most, for each pixel that its edge crosses.
TEST_P(Formats, ImagesCoverTheAreaOfTheContours) {
  const TemporaryFolder folder;
  const std::vector<LayerFacts> contours =
      read_json(slice(GetParam(), folder, ".layers.json", {"--layer", "0.5"}));
  constexpr double kPixel = 0.04725;
  for (const std::string ending : {".sl1", ".png", ".zip"}) {
    SCOPED_TRACE(ending);
    const std::vector<LayerFacts> images = read_independently(
        slice(GetParam(), folder, ending, {"--layer", "0.5"}));
    ASSERT_EQ(images.size(), contours.size());
    for (std::size_t i = 0; i < images.size(); ++i) {
      EXPECT_NEAR(images[i].height, contours[i].height, 2e-6);
      const double crossed = 4 + 2 * contours[i].perimeter / kPixel;
      EXPECT_NEAR(images[i].area, contours[i].area,
                  crossed * kPixel * kPixel / 2 / 255)
          << "layer " << i;
    }
  }
}

// Three pixels of the panel are one of the image.
TEST(NanoDlp, PacksPixelsAsThePanelWants) {
  const TemporaryFolder folder;
  const std::string profile = folder.write(
      "rgb.json", R"({"name":"rgb","pixels":[1200,900],"pixel_mm":[0.04,0.06],)"
                  R"("right":"-x","up":"+y","nanodlp_pixels":"rgb"})");
  const std::vector<LayerFacts> images = read_independently(slice(
      "signet", folder, ".nanodlp", {"--layer", "0.5", "--printer", profile}));
  const std::vector<LayerFacts> contours =
      read_json(slice("signet", folder, ".layers.json", {"--layer", "0.5"}));
  ASSERT_EQ(images.size(), contours.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const double crossed = 4 + 2 * contours[i].perimeter / 0.04;
    EXPECT_NEAR(images[i].area, contours[i].area,
                crossed * 0.04 * 0.06 / 2 / 255);
  }
}

class Bytes : public testing::TestWithParam<const char*> {};

TEST_P(Bytes, AreTheSameForAnyNumberOfThreads) {
  std::string expected;
  for (const char* const threads : {"1", "2", "3"}) {
    const TemporaryFolder folder;
    std::string path =
        slice("solitaire", folder, GetParam(), {"--threads", threads});
    // Of a folder, its last image.
    if (std::filesystem::is_directory(path)) path += "/00239.png";
    const std::string bytes = support::read_file(path);
    EXPECT_GT(bytes.size(), 1000U);
    if (expected.empty()) expected = bytes;
    EXPECT_TRUE(bytes == expected) << threads << " threads";
  }
}

// As of a disk with room for 2 KB.
TEST_P(Bytes, ThatFindNoRoomLeaveNothing) {
  const TemporaryFolder folder;
  const std::string output = folder.file(std::string("a") + GetParam());
  const ProcessResult result =
      run_process({"/bin/bash", "-c", "trap '' XFSZ; ulimit -f 2; exec \"$@\"",
                   "-", LAMINA_PROGRAM, design_path("solitaire"), "-o",
                   output_of(output), "-q"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors,
            "error: Can't write '" + output + "': File too large\n");
  EXPECT_EQ(folder.entry_count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(AllFormats, Bytes,
                         testing::Values(".slc", ".cli", ".svg", ".png", ".sl1",
                                         ".zip", ".slices.3mf", ".layers.json"),
                         [](const auto& ending) {
                           const std::string name = ending.param;
                           return name.substr(name.rfind('.') + 1);
                         });

// Designs that begin at z = 0, where slic3r sets every part, and that have no
// gap below 0.1 mm, which it closes.
class CutBySlic3r : public testing::TestWithParam<const char*> {};

// Its mesh has rounded vertices, it computes on integers of 1e-6 mm and leaves
// points out.
TEST_P(CutBySlic3r, GivesTheSameLayers) {
  const support::OpenScadResult mesh =
      support::ask_openscad(design_path(GetParam()), "stl");
  ASSERT_FALSE(mesh.output.empty()) << mesh.words;
  const TemporaryFolder folder;
  const std::string cut = folder.file("cut.svg");
  must_run({"/usr/bin/slic3r", "--export-svg", mesh.output.string(), "-o", cut,
            "--layer-height", "0.1", "--first-layer-height", "0.1",
            "--resolution", "0"});
  expect_same_layers(read_independently(slice(GetParam(), folder, ".svg")),
                     read_independently(cut), 3e-4);
}

INSTANTIATE_TEST_SUITE_P(Examples, CutBySlic3r,
                         testing::Values("hoop", "solitaire", "signet"),
                         [](const auto& design) {
                           return std::string(design.param);
                         });

}  // namespace
}  // namespace lamina
