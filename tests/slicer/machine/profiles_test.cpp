// Profiles of printers and materials: those that lamina knows, and faulty ones.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/diagnostic.h"
#include "slicer/machine/build_volume.h"
#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using nlohmann::json;
using support::TemporaryFolder;
namespace fs = std::filesystem;

json read_json(const fs::path& path) {
  std::ifstream file(path);
  return json::parse(file);
}

TEST(KnownPrinters, AreMoreThanTwentyWithASourceEach) {
  const auto printers = known_printers();
  EXPECT_GT(printers.size(), 30U);
  std::set<std::string> names;
  for (const Printer& printer : printers) {
    EXPECT_TRUE(names.insert(printer.name).second) << printer.name;
    EXPECT_NE(printer.source, "") << printer.name;
    EXPECT_FALSE(printer.reads.empty() && printer.name != "plain")
        << printer.name;
    if (printer.name == "plain") continue;
    EXPECT_GT(printer.build_height, 100) << printer.name;
    const Vec3 volume = printer.build_volume();
    EXPECT_GT(volume.x * volume.y, 60 * 60) << printer.name;
  }
  for (const Material& material : known_materials()) {
    EXPECT_NE(material.source, "") << material.name;
    for (const KnownExposure& known : material.exposures) {
      EXPECT_TRUE(names.contains(known.printer)) << material.name;
      EXPECT_NE(known.source, "") << material.name;
      EXPECT_GT(known.exposure.layer, 0) << material.name;
      EXPECT_GE(known.exposure.first, known.exposure.layer) << material.name;
    }
  }
}

// Thirds of gold weigh less than three quarters, and what is whitened with
// palladium more than what is whitened with nickel.
TEST(KnownMaterials, OfMoreGoldAreHeavier) {
  const auto density = [](const char* name) {
    const Material metal = find_material(name);
    EXPECT_TRUE(metal.is_metal()) << name;
    return metal.density;
  };
  for (const std::string colour : {"yellow", "white"}) {
    EXPECT_LT(density(("gold-375-" + colour).c_str()),
              density(("gold-585-" + colour).c_str()));
    EXPECT_LT(density(("gold-585-" + colour).c_str()),
              density(("gold-750-" + colour).c_str()));
    EXPECT_LT(density(("gold-750-" + colour).c_str()), density("fine gold"));
  }
  for (const std::string fineness : {"585", "750"}) {
    EXPECT_LT(density(("gold " + fineness + " white").c_str()),
              density(("gold-" + fineness + "-palladium-white").c_str()));
  }
  EXPECT_LT(density("silver 925"), density("silver-935"));
  EXPECT_LT(density("silver-935"), density("fine silver"));
  EXPECT_FALSE(find_material("casting wax").is_metal());
}

void expect_schema(const json& object, const json& schema,
                   const fs::path& file) {
  for (const auto& [member, value] : object.items()) {
    EXPECT_TRUE(schema.at("properties").contains(member))
        << file << ": " << member;
  }
  for (const json& member : schema.at("required")) {
    EXPECT_TRUE(object.contains(member)) << file << ": " << member;
  }
}

// The schemas list the members that are read, and the profiles keep to them.
TEST(Profiles, KeepToTheirSchema) {
  const fs::path folder = LAMINA_MACHINES;
  for (const std::string kind : {"printer", "material"}) {
    const json schema = read_json(folder / (kind + ".schema.json"));
    for (const auto& file : fs::directory_iterator(folder / (kind + "s"))) {
      if (file.path().extension() != ".json") continue;
      const json profile = read_json(file.path());
      EXPECT_EQ(profile.at("name"), file.path().stem().string());
      expect_schema(profile, schema, file.path());
      if (!profile.contains("exposures")) continue;
      for (const json& exposure : profile.at("exposures")) {
        expect_schema(exposure, schema.at("$defs").at("exposure"), file.path());
      }
    }
  }
}

std::string fault_of(const std::string& text, bool is_printer) {
  const TemporaryFolder folder;
  folder.write("a.json", text);
  try {
    if (is_printer) {
      find_printer(folder.file("a.json"));
    } else {
      find_material(folder.file("a.json"));
    }
  } catch (const FileError& error) {
    const std::string words = error.what();
    return words.substr(words.find("json': ") + 7);
  }
  return "";
}

TEST(Profiles, SayWhatIsWrong) {
  EXPECT_EQ(fault_of(R"({"name": "a", "density": 1.2})", false), "");
  EXPECT_EQ(fault_of(R"({"name": "a", "density": 99})", false),
            "density is from 0.01 to 25, not 99");
  EXPECT_EQ(fault_of(R"({"name": "a"})", false), "key 'density' not found");
  EXPECT_EQ(fault_of(R"({"name": "a", "density": 1, "exposure": 3})", false),
            "there is no member 'exposure'; did you mean 'exposures'?");
  EXPECT_EQ(
      fault_of(R"({"name": "a", "density": 1, "exposures": [{}]})", false),
      "key 'exposure_s' not found");
  EXPECT_EQ(fault_of(R"({"name": "a", "density": 1, "price_per_gram": 1,
                         "price_per_ounce": 30})",
                     false),
            "it has two prices");
  const std::string printer =
      R"({"name": "a", "pixels": [9, 9], "pixel_mm": [1, 1], "right": "+x",)";
  EXPECT_EQ(fault_of(printer + R"("up": "+y"})", true), "");
  EXPECT_EQ(fault_of(printer + R"("up": "+y", "height_mm": -1})", true),
            "height_mm is from 0.001 to 10000, not -1");
  EXPECT_EQ(fault_of(printer + R"("up": "+y", "hight_mm": 1})", true),
            "there is no member 'hight_mm'; did you mean 'height_mm'?");
  EXPECT_EQ(fault_of(printer + R"("up": "+y", "plate_mm": [9, 9]})", true),
            "plate_mm is for printers without pixels");
  EXPECT_EQ(fault_of(R"({"name": "a", "plate_mm": [9, 0]})", true),
            "plate_mm must be positive");
}

// Their texts stand in settings of machines, in messages and on pages.
TEST(Profiles, HaveTextsOfOneLine) {
  const TemporaryFolder folder;
  const std::string line = "a\\u000AexpTime = 0.1\\u202E";
  folder.write("material.json",
               R"({"name": "a\nexpTime = 0.1\u202e", "density": 1,
                   "price_per_gram": 1, "currency": "a\nexpTime = 0.1\u202e"})");
  const Material material = find_material(folder.file("material.json"));
  EXPECT_EQ(material.name, line);
  EXPECT_EQ(material.title, line);
  EXPECT_EQ(material.price->currency, line);
  folder.write("printer.json",
               R"({"name": "a", "title": "a\nexpTime = 0.1\u202e",
                   "pixels": [9, 9], "pixel_mm": [1, 1],
                   "right": "+x", "up": "+y"})");
  EXPECT_EQ(find_printer(folder.file("printer.json")).title, line);
}

std::string fault_of_printer(const std::string& name) {
  try {
    return "found " + find_printer(name).name;
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(Profiles, GuessNames) {
  EXPECT_EQ(fault_of_printer("ellego-mars-3"),
            "Can't use printer 'ellego-mars-3': did you mean 'elegoo-mars-3'? "
            "'lamina printers' lists those that lamina knows, and a file of "
            "your own ends in .json");
}

TEST(Profiles, AreFoundByTheirTitleOrAPartThatNoOtherHas) {
  for (const char* name : {"Elegoo Mars 3", "elegoo mars 3", "mars 3", "MARS3",
                           "mars-3", "elegoo-mars-3"}) {
    EXPECT_EQ(fault_of_printer(name), "found elegoo-mars-3") << name;
  }
  // A whole name, though it is a part of others.
  EXPECT_EQ(fault_of_printer("Elegoo Saturn"), "found elegoo-saturn");
  EXPECT_EQ(fault_of_printer("saturn4ultra"),
            "Can't use printer 'saturn4ultra': it could be "
            "elegoo-saturn-4-ultra-12k or elegoo-saturn-4-ultra-16k");
  const std::string many = fault_of_printer("photon mono");
  EXPECT_NE(many.find("more ('lamina printers photon mono' lists them)"),
            std::string::npos)
      << many;
  // Parts begin words.
  EXPECT_NE(fault_of_printer("ars 3").find("lists those that lamina knows"),
            std::string::npos);
  EXPECT_EQ(find_material("gold 750").name, "gold-18k-yellow");
  EXPECT_EQ(find_material("platinum").name, "platinum-950");
}

TEST(Printer, OfContoursHasNoPanel) {
  const Printer printer = find_printer("b9creator");
  EXPECT_FALSE(printer.has_panel());
  EXPECT_EQ(printer.build_volume(), Vec3(102.4, 76.8, 203.2));
}

TEST(TooLarge, NamesPrintersThatAreLargeEnough) {
  const Printer mars = find_printer("elegoo-mars-3");
  const std::string words = TooLarge(mars, Vec3(20, 20, 280)).what();
  EXPECT_TRUE(words.starts_with(
      "The design is 20 x 20 x 280 mm, larger than what elegoo-mars-3 builds: "
      "143.43 x 89.6 x 175 mm; it fits "))
      << words;
  EXPECT_NE(words.find("; it fits elegoo-jupiter (277.848 x 156.264 x 300 mm), "
                       "elegoo-jupiter-2 (302.4 x 161.98 x 300 mm) or "
                       "anycubic-photon-m3-max ("),
            std::string::npos)
      << words;
  EXPECT_NE(std::string(TooLarge(mars, Vec3(4, 4, 500)).what())
                .find("lamina knows no printer that is large enough"),
            std::string::npos);
}

Layer layer_of(Vec2 size, double bottom, double top) {
  Layer layer;
  layer.bottom = bottom;
  layer.top = top;
  layer.contours.points = {{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
  layer.contours.ends = {4};
  return layer;
}

TEST(BuildVolumeSink, TakesWhatFitsToTheLastMicrometre) {
  const Printer mars = find_printer("elegoo-mars-3");
  const Vec3 volume = mars.build_volume();
  LayerDrain drain;
  BuildVolumeSink sink(mars, drain);
  sink.begin({Vec3(0), volume});
  EXPECT_NO_THROW(sink.take(layer_of({volume.x, volume.y}, 0, volume.z)));
  EXPECT_THROW(
      sink.take(layer_of({volume.x, volume.y}, volume.z, volume.z + 1)),
      GeometryError);
  EXPECT_THROW(sink.take(layer_of({volume.x + 0.01, 1}, 0, 1)), GeometryError);
}

}  // namespace
}  // namespace lamina::slicer
