// Images for resin printers: what goes where on the printer, and when a folder
// may be replaced. Their areas are checked in tests/formats.

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <png.h>

#include "base/diagnostic.h"
#include "slicer/formats/layer_writer.h"
#include "tests/support/contour_checks.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using support::add_loop;
using support::read_file;
using support::TemporaryFolder;
using Rows = std::vector<std::vector<int>>;

// 4 × 3 pixels of 1 mm × 2 mm.
Printer small_printer() {
  Printer printer;
  printer.name = "small";
  printer.width = 4;
  printer.height = 3;
  printer.pixel = {1, 2};
  return printer;
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

void write_folder(const std::string& path, const Printer& printer,
                  const std::vector<Layer>& layers, const Box3& box) {
  TemporaryFiles files;
  const auto writer = make_layer_writer(
      {.format = OutputFormat::kPng, .printer = printer}, path, files);
  writer->begin(box);
  for (const Layer& layer : layers) writer->take(layer);
  Diagnostics unheard;
  writer->finish(unheard);
  writer->commit();
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

// One and a half pixels of the printer: its middle is at (12, 23).
const std::vector<Vec2> kBar = {{12, 21}, {13.5, 21}, {13.5, 23}, {12, 23}};
const Box3 kBox = box_around({10, 20}, {14, 26});

TEST(ImageStackWriter, PutsTheMiddleOfTheBoxInTheMiddle) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  write_folder(path, small_printer(), {layer_of(kBar)}, kBox);
  // The middle row shows y from 22 to 24, the lowest one from 20 to 22.
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{0, 0, 0, 0}, {0, 0, 128, 64}, {0, 0, 128, 64}}));
}

TEST(ImageStackWriter, TurnsAsThePanelIsSeen) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  Printer printer = small_printer();
  printer.right = {-1, 0};
  write_folder(path, printer, {layer_of(kBar)}, kBox);
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{0, 0, 0, 0}, {64, 128, 0, 0}, {64, 128, 0, 0}}));
  printer = small_printer();
  printer.up = {0, -1};
  write_folder(path, printer, {layer_of(kBar)}, kBox);
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{0, 0, 128, 64}, {0, 0, 128, 64}, {0, 0, 0, 0}}));
  // A quarter turn: y to the right, x upwards, pixels of 1 mm × 2 mm again.
  printer.right = {0, 1};
  printer.up = {1, 0};
  write_folder(path, printer, {layer_of(kBar)}, kBox);
  EXPECT_EQ(read_png(path + "/00000.png"),
            (Rows{{64, 64, 0, 0}, {128, 128, 0, 0}, {0, 0, 0, 0}}));
}

TEST(ImageStackWriter, TellsWhatTheFolderHolds) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  write_folder(path, small_printer(), {layer_of(kBar)}, kBox);
  const auto index = nlohmann::json::parse(read_file(path + "/index.json"));
  EXPECT_EQ(index.at("pixels"), (std::array<int, 2>{4, 3}));
  EXPECT_EQ(index.at("pixel_mm"), (std::array<double, 2>{1, 2}));
  EXPECT_EQ(index.at("volume_mm3"), 1.5);
  EXPECT_EQ(index.at("layers").at(0).at("file"), "00000.png");
  EXPECT_EQ(index.at("layers").at(0).at("z"), 0.25);
}

TEST(ImageStackWriter, RefusesWhatReachesBeyondThePanel) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_folder(folder.file("a.png"), small_printer(),
                            {layer_of({{0, 0}, {4.1, 0}, {0, 1}})},
                            box_around({0, 0}, {4.1, 1})),
               GeometryError);
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(ImageStackWriter, APartAsLargeAsThePanelFits) {
  const TemporaryFolder folder;
  for (const char* const name : {"plain", "prusa-sl1", "elegoo-mars-3"}) {
    const Printer printer = find_printer(name);
    const bool is_turned = printer.right.x == 0;
    const Vec2 size(printer.width * printer.pixel.x,
                    printer.height * printer.pixel.y);
    const Vec2 low(33.3, 17.7);
    const Vec2 high = low + (is_turned ? Vec2(size.y, size.x) : size);
    write_folder(folder.file(name), printer,
                 {layer_of({low, {high.x, low.y}, high, {low.x, high.y}})},
                 box_around(low, high));
    const Rows rows = read_png(folder.file(name) + "/00000.png");
    EXPECT_EQ(rows, Rows(printer.height, std::vector<int>(printer.width, 255)))
        << name;
  }
}

TEST(ImageStackWriter, TellsTheThicknessWithoutRounding) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  Layer layer = layer_of(kBar);
  layer.bottom = 9.95;
  layer.top = 10;  // 0.05000000000000071 higher
  write_folder(path, small_printer(), {layer}, kBox);
  const auto index = nlohmann::json::parse(read_file(path + "/index.json"));
  EXPECT_EQ(index.at("layer_thickness"), 0.05);
}

TEST(ImageStackWriter, ArchivesHoldLayersOfOneThickness) {
  const TemporaryFolder folder;
  Layer thicker = layer_of(kBar);
  thicker.top = 1;
  const std::vector<Layer> layers = {layer_of(kBar), thicker};
  for (const auto format : {OutputFormat::kSl1, OutputFormat::kNanoDlp}) {
    TemporaryFiles files;
    const auto writer =
        make_layer_writer({.format = format, .printer = small_printer()},
                          folder.file("a"), files);
    writer->begin(kBox);
    writer->take(layers[0]);
    EXPECT_THROW(writer->take(layers[1]), GeometryError);
  }
  EXPECT_EQ(folder.entry_count(), 0U);
  write_folder(folder.file("a.png"), small_printer(), layers, kBox);
  const auto index =
      nlohmann::json::parse(read_file(folder.file("a.png/index.json")));
  EXPECT_EQ(index.at("layer_thickness"), 0);
}

TEST(ImageStackWriter, FollowsLinksToFolders) {
  const TemporaryFolder folder;
  const Layer layer = layer_of(kBar);
  std::filesystem::create_directory(folder.file("real"));
  std::filesystem::create_directory_symlink("real", folder.file("a.png"));
  write_folder(folder.file("a.png"), small_printer(), {layer, layer}, kBox);
  write_folder(folder.file("a.png"), small_printer(), {layer}, kBox);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("a.png")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("real/00000.png")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("real/00001.png")));
  // Also to one that is not there yet.
  std::filesystem::create_directory_symlink("new", folder.file("b.png"));
  write_folder(folder.file("b.png"), small_printer(), {layer}, kBox);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("b.png")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("new/00000.png")));
  EXPECT_EQ(folder.entry_count(), 4U);
}

TEST(ImageStackWriter, NamesInArchivesAreUtf8) {
  const TemporaryFolder folder;
  const std::string path = folder.file("Rîng.sl1");
  TemporaryFiles files;
  const auto writer = make_layer_writer(
      {.format = OutputFormat::kSl1, .printer = small_printer()}, path, files);
  writer->begin(kBox);
  writer->take(layer_of(kBar));
  Diagnostics unheard;
  writer->finish(unheard);
  writer->commit();
  const auto listing = support::run_process(
      {"/usr/bin/python3", "-c",
       "import sys, zipfile; print(zipfile.ZipFile(sys.argv[1]).namelist())",
       path});
  EXPECT_EQ(listing.output,
            "['Rîng00000.png', 'config.ini', 'prusaslicer.ini', "
            "'thumbnail/thumbnail400x400.png', "
            "'thumbnail/thumbnail800x480.png']\n")
      << listing.errors;
}

// A file of the archive that the writer makes of one layer.
std::string text_in_archive(const TemporaryFolder& folder,
                            const std::string& file, OutputFormat format,
                            const std::string& entry) {
  TemporaryFiles files;
  const std::string path = folder.file(file);
  const auto writer = make_layer_writer(
      {.format = format, .printer = small_printer()}, path, files);
  writer->begin(kBox);
  writer->take(layer_of(kBar));
  Diagnostics unheard;
  writer->finish(unheard);
  writer->commit();
  const auto text = support::run_process(
      {"/usr/bin/python3", "-c",
       "import sys, zipfile\n"
       "archive = zipfile.ZipFile(sys.argv[1])\n"
       "sys.stdout.buffer.write(archive.read(sys.argv[2]))",
       path, entry});
  EXPECT_EQ(text.status, 0) << text.errors;
  return text.output;
}

TEST(ImageStackWriter, ANameIsNoSetting) {
  const TemporaryFolder folder;
  const OutputFormat sl1 = OutputFormat::kSl1;
  std::string plain = text_in_archive(folder, "ring.sl1", sl1, "config.ini");
  const std::string line = "jobDir = ring\n";
  const std::size_t at = plain.find(line);
  ASSERT_NE(at, std::string::npos);
  plain.replace(at, line.size(),
                "jobDir = ring\\u000AexpTime = 1\\u2028hollow = 1\uFFFD\n");
  EXPECT_EQ(text_in_archive(folder, "ring\nexpTime = 1\u2028hollow = 1\xff.sl1",
                            sl1, "config.ini"),
            plain);
}

TEST(ImageStackWriter, AnyNameIsOneForNanoDlp) {
  const TemporaryFolder folder;
  const auto plate = nlohmann::json::parse(text_in_archive(
      folder, "R\xeeng.zip", OutputFormat::kNanoDlp, "plate.json"));
  EXPECT_EQ(plate.at("Path"), "R\uFFFDng");
}

TEST(ImageStackWriter, ReplacesOnlyFoldersOfItsOwn) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.png");
  const Layer layer = layer_of(kBar);
  write_folder(path, small_printer(), {layer, layer}, kBox);
  EXPECT_TRUE(std::filesystem::exists(path + "/00001.png"));
  write_folder(path, small_printer(), {layer}, kBox);
  EXPECT_FALSE(std::filesystem::exists(path + "/00001.png"));
  EXPECT_EQ(folder.entry_count(), 1U);

  // A letter among the images, and another program's file of contents.
  std::ofstream(path + "/letter.txt") << "dear";
  EXPECT_THROW(write_folder(path, small_printer(), {layer}, kBox), FileError);
  EXPECT_EQ(read_file(path + "/letter.txt"), "dear");
  std::filesystem::remove(path + "/letter.txt");
  write_folder(path, small_printer(), {layer}, kBox);
  std::ofstream(path + "/index.json") << "{\"file\": \"00000.png\"}";
  EXPECT_THROW(write_folder(path, small_printer(), {layer}, kBox), FileError);

  std::filesystem::create_directory(folder.file("mine"));
  std::ofstream(folder.file("mine/letter.txt")) << "dear";
  EXPECT_THROW(
      write_folder(folder.file("mine"), small_printer(), {layer}, kBox),
      FileError);
  EXPECT_EQ(read_file(folder.file("mine/letter.txt")), "dear");
  std::ofstream(folder.file("file.png")) << "picture";
  EXPECT_THROW(
      write_folder(folder.file("file.png"), small_printer(), {layer}, kBox),
      FileError);
  EXPECT_EQ(read_file(folder.file("file.png")), "picture");
  EXPECT_EQ(folder.entry_count(), 3U);
}

TEST(ImageStackWriter, AnInterruptLeavesNothing) {
  const TemporaryFolder folder;
  // Never destroyed: after discard_all nothing can be, as in a process that
  // is about to end.
  static auto* const files = new TemporaryFiles;
  static auto* const writer = make_layer_writer({.format = OutputFormat::kPng,
                                                 .printer = small_printer()},
                                                folder.file("a.png"), *files)
                                  .release();
  writer->begin(kBox);
  writer->take(layer_of(kBar));
  EXPECT_EQ(folder.entry_count(), 1U);
  files->discard_all();
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Printer, IsFoundByNameOrFile) {
  EXPECT_EQ(find_printer("prusa-sl1").height, 2560U);
  const TemporaryFolder folder;
  const std::string good = folder.write(
      "good.json",
      R"({"name":"mine","pixels":[100,50],"pixel_mm":[0.1,0.2],"right":"-x","up":"+y"})");
  const Printer printer = find_printer(good);
  EXPECT_EQ(printer.name, "mine");
  EXPECT_EQ(printer.width, 100U);
  EXPECT_EQ(printer.right, Vec2(-1, 0));
  for (
      const char* const text :
      {"", "{}", "[1]",
       R"({"name":"a","pixels":[0,5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,-5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[0,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"+x","up":"-x"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"z","up":"+y"})",
       R"({"name":"a","pixels":[5.5,5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[-4294967196,5],"pixel_mm":[1,1],"right":"+x","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"","up":"+y"})",
       R"({"name":"a","pixels":[5,5],"pixel_mm":[1,1],"right":"+-x","up":"+y"})"}) {
    const std::string bad = folder.write("bad.json", text);
    EXPECT_THROW(find_printer(bad), FileError) << text;
  }
  std::filesystem::create_directory(folder.file("folder.json"));
  EXPECT_THROW(find_printer(folder.file("folder.json")), FileError);
  EXPECT_THROW(find_printer("unknown"), FileError);
  EXPECT_THROW(find_printer(folder.file("none.json")), FileError);
}

}  // namespace
}  // namespace lamina::slicer
