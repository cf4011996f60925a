// Images for resin printers: what goes where on the panel, and when a folder
// may be replaced. Their areas are checked in tests/formats.

#include "slicer/formats/image_stack_writer.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <png.h>

#include "parser/diagnostic.h"
#include "tests/support/contour_checks.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using support::add_loop;
using support::read_file;
using support::TemporaryFolder;
using Rows = std::vector<std::vector<int>>;

// 4 × 3 pixels of 1 mm × 2 mm.
Panel small_panel() {
  Panel panel;
  panel.name = "small";
  panel.width = 4;
  panel.height = 3;
  panel.pixel = {1, 2};
  return panel;
}

Layer layer_of(const std::vector<Vec2>& loop) {
  Layer layer;
  layer.section_z = 0.25;
  layer.top = 0.5;
  add_loop(layer.contours, loop);
  return layer;
}

Box3 box_around(Vec2 low, Vec2 high) {
  Box3 box;
  box.low = Vec3(low, 0);
  box.high = Vec3(high, 1);
  return box;
}

void write_folder(const std::string& path, const Panel& panel,
                  const std::vector<Layer>& layers, const Box3& box) {
  TemporaryFiles files;
  ImageStackWriter writer(OutputFormat::kPng, panel, path, files);
  writer.begin(box);
  for (const Layer& layer : layers) writer.take(layer);
  Diagnostics unheard;
  writer.finish(unheard);
  writer.commit();
}

Rows read_png(const std::string& path) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0);
  image.format = PNG_FORMAT_GRAY;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr),
            0);
  Rows rows(image.height);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    rows[i / image.width].push_back(bytes[i]);
  }
  return rows;
}

// One and a half pixels of the panel: its middle is at (12, 23).
const std::vector<Vec2> kBar = {{12, 21}, {13.5, 21}, {13.5, 23}, {12, 23}};
const Box3 kBox = box_around({10, 20}, {14, 26});

TEST(ImageStackWriter, PutsTheMiddleOfTheBoxInTheMiddle) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  write_folder(path, small_panel(), {layer_of(kBar)}, kBox);
  // The middle row shows y from 22 to 24, the lowest one from 20 to 22.
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{0, 0, 0, 0}, {0, 0, 128, 64}, {0, 0, 128, 64}}));
}

TEST(ImageStackWriter, TurnsAsThePanelIsSeen) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  Panel panel = small_panel();
  panel.right = {-1, 0};
  write_folder(path, panel, {layer_of(kBar)}, kBox);
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{0, 0, 0, 0}, {64, 128, 0, 0}, {64, 128, 0, 0}}));
  panel = small_panel();
  panel.up = {0, -1};
  write_folder(path, panel, {layer_of(kBar)}, kBox);
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{0, 0, 128, 64}, {0, 0, 128, 64}, {0, 0, 0, 0}}));
  // A quarter turn: y to the right, x upwards, pixels of 1 mm × 2 mm again.
  panel.right = {0, 1};
  panel.up = {1, 0};
  write_folder(path, panel, {layer_of(kBar)}, kBox);
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{64, 64, 0, 0}, {128, 128, 0, 0}, {0, 0, 0, 0}}));
}

TEST(ImageStackWriter, TellsWhatTheFolderHolds) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  write_folder(path, small_panel(), {layer_of(kBar)}, kBox);
  const auto index = nlohmann::json::parse(read_file(path + "/index.json"));
  EXPECT_EQ(index.at("pixels"), (std::array<int, 2>{4, 3}));
  EXPECT_EQ(index.at("pixel_mm"), (std::array<double, 2>{1, 2}));
  EXPECT_EQ(index.at("volume_mm3"), 1.5);
  EXPECT_EQ(index.at("layers").at(0).at("file"), "00000.png");
  EXPECT_EQ(index.at("layers").at(0).at("z"), 0.25);
}

TEST(ImageStackWriter, RefusesWhatReachesBeyondThePanel) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_folder(folder.file("a.png"), small_panel(),
                            {layer_of({{0, 0}, {4.1, 0}, {0, 1}})},
                            box_around({0, 0}, {4.1, 1})),
               GeometryError);
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(ImageStackWriter, ReplacesOnlyFoldersOfItsOwn) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  const Layer layer = layer_of(kBar);
  write_folder(path, small_panel(), {layer, layer}, kBox);
  EXPECT_TRUE(std::filesystem::exists(path + "/00001.png"));
  write_folder(path, small_panel(), {layer}, kBox);
  EXPECT_FALSE(std::filesystem::exists(path + "/00001.png"));
  EXPECT_EQ(folder.entry_count(), 1U);

  std::filesystem::create_directory(folder.file("mine"));
  std::ofstream(folder.file("mine/letter.txt")) << "dear";
  EXPECT_THROW(write_folder(folder.file("mine"), small_panel(), {layer}, kBox),
               FileError);
  EXPECT_EQ(read_file(folder.file("mine/letter.txt")), "dear");
  std::ofstream(folder.file("file.png")) << "picture";
  EXPECT_THROW(
      write_folder(folder.file("file.png"), small_panel(), {layer}, kBox),
      FileError);
  EXPECT_EQ(read_file(folder.file("file.png")), "picture");
  EXPECT_EQ(folder.entry_count(), 3U);
}

TEST(ImageStackWriter, AnInterruptLeavesNothing) {
  const TemporaryFolder folder;
  // Never destroyed: after discard_all nothing can be, as in a process that
  // is about to end.
  static auto* const files = new TemporaryFiles;
  static auto* const writer = new ImageStackWriter(
      OutputFormat::kPng, small_panel(), folder.file("a.png"), *files);
  writer->begin(kBox);
  writer->take(layer_of(kBar));
  EXPECT_EQ(folder.entry_count(), 1U);
  files->discard_all();
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Panel, IsFoundByNameOrFile) {
  EXPECT_EQ(find_panel("prusa-sl1").height, 2560U);
  const TemporaryFolder folder;
  const std::string good = folder.write(
      "good.json",
      R"({"name":"mine","pixels":[100,50],"pixel_mm":[0.1,0.2],"right":"-x","up":"+y"})");
  const Panel panel = find_panel(good);
  EXPECT_EQ(panel.name, "mine");
  EXPECT_EQ(panel.width, 100U);
  EXPECT_EQ(panel.right, Vec2(-1, 0));
  for (
      const char* const text :
      {"", "{}", "[1]",
       R"({"name":"a","pixels":[0,5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,-5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[0,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"+x","up":"-x"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"z","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"+-","up":"+y"})"}) {
    const std::string bad = folder.write("bad.json", text);
    EXPECT_THROW(find_panel(bad), FileError) << text;
  }
  EXPECT_THROW(find_panel("unknown"), FileError);
  EXPECT_THROW(find_panel(folder.file("none.json")), FileError);
}

}  // namespace
}  // namespace lamina::slicer
