// The designs of examples/, as a goldsmith would check them with calipers.
//
// Each runs through the program like a user's own. What the layers must show
// follows from the parameters: the finger hole measures what the ring size
// says, a head of six prongs has six tips, every stone has its hole. Volumes
// are those of OpenSCAD 2021.01's meshes.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plane/contours.h"
#include "tests/support/contour_checks.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

using support::LoopCounts;
using support::ProcessResult;
using Options = std::vector<std::string>;

ProcessResult run_lamina(Options arguments) {
  arguments.insert(arguments.begin(), LAMINA_PROGRAM);
  return support::run_process(arguments);
}

std::string design_path(const std::string& name) {
  return fmt::format("{}/{}.scad", LAMINA_EXAMPLES, name);
}

struct SlicedLayer {
  double z = 0;
  double bottom = 0;
  double top = 0;
  plane::Contours contours;
};
using Layers = std::vector<SlicedLayer>;

SlicedLayer to_layer(const nlohmann::json& json) {
  SlicedLayer layer{json.at("z"), json.at("bottom"), json.at("top"), {}};
  for (const auto& contour : json.at("contours")) {
    std::vector<Vec2> points;
    for (const auto& point : contour.at("points")) {
      points.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
    }
    support::add_loop(layer.contours, points);
  }
  return layer;
}

// Layers of a file. Any warning is a failure.
Layers slice_file(const std::string& path, Options options) {
  const support::TemporaryFolder folder;
  const std::string file = folder.file("out.layers.json");
  options.insert(options.begin(), {path, "-q", "--hardwarnings", "-o", file});
  const ProcessResult outcome = run_lamina(options);
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  Layers layers;
  if (outcome.status != 0) return layers;
  const auto json = nlohmann::json::parse(support::read_file(file));
  for (const auto& layer : json.at("layers")) {
    layers.push_back(to_layer(layer));
  }
  EXPECT_FALSE(layers.empty());
  return layers;
}

Layers slice(const std::string& name, const Options& options) {
  return slice_file(design_path(name), options);
}

// The one layer at height z.
SlicedLayer slice_at(const std::string& name, double z, Options options = {}) {
  options.insert(options.end(),
                 {"--tolerance", "0", "--heights", fmt::format("{}", z)});
  const Layers layers = slice(name, options);
  EXPECT_EQ(layers.size(), 1U);
  return layers.empty() ? SlicedLayer{} : layers.front();
}

double volume(const Layers& layers) {
  double sum = 0;
  for (const SlicedLayer& layer : layers) {
    sum += support::total_area(layer.contours) * (layer.top - layer.bottom);
  }
  return sum;
}

// The axis of a finger: x = y = 0, or lying along y at height `height`.
struct Finger {
  bool lies = false;
  double height = 0;
};

// Distance of the edge a-b, at height z, from the finger's axis.
double distance_to_axis(const Finger& finger, Vec2 a, Vec2 b, double z) {
  if (finger.lies) {
    const double x =
        a.x * b.x <= 0 ? 0 : std::min(std::abs(a.x), std::abs(b.x));
    return std::hypot(x, z - finger.height);
  }
  const Vec2 v = b - a;
  const double square = v.x * v.x + v.y * v.y;
  const double t =
      square > 0 ? std::clamp(-(a.x * v.x + a.y * v.y) / square, 0.0, 1.0) : 0;
  return std::hypot(a.x + t * v.x, a.y + t * v.y);
}

// Radius of the largest cylinder round the axis that no wall enters: what ISO
// 8653 measures.
double free_radius(const Layers& layers, const Finger& finger) {
  double least = 1e300;
  for (const SlicedLayer& layer : layers) {
    for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
      const std::span<const Vec2> loop = layer.contours.loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        least = std::min(
            least, distance_to_axis(finger, loop[k],
                                    loop[(k + 1) % loop.size()], layer.z));
      }
    }
  }
  return least;
}

struct Design {
  const char* name;
  double volume;  // mm³, of `openscad -o x.stl examples/<name>.scad`
  double height;  // mm, of the same mesh
};

void PrintTo(const Design& design, std::ostream* out) { *out << design.name; }

class Examples : public testing::TestWithParam<Design> {};

TEST_P(Examples, CompileToSlcWithoutWarningAndPassInspection) {
  const support::TemporaryFolder folder;
  const std::string file = folder.file("out.slc");
  const ProcessResult made = run_lamina(
      {design_path(GetParam().name), "-q", "--hardwarnings", "-o", file});
  ASSERT_EQ(made.status, 0) << made.errors;
  EXPECT_EQ(made.errors.find("warning"), std::string::npos) << made.errors;
  const ProcessResult inspected = run_lamina({"inspect", file});
  EXPECT_EQ(inspected.status, 0) << inspected.output << inspected.errors;
}

TEST_P(Examples, StandOnTheirPlateAsHighAsOpenScadGives) {
  const Layers layers = slice(GetParam().name, {"--layer", "0.02"});
  ASSERT_FALSE(layers.empty());
  EXPECT_NEAR(layers.front().bottom, 0, 1e-6);
  EXPECT_NEAR(layers.back().top, GetParam().height, 0.02);
}

TEST_P(Examples, HaveTheVolumeThatOpenScadGives) {
  const Layers layers =
      slice(GetParam().name, {"--layer", "0.02", "--tolerance", "0"});
  EXPECT_NEAR(volume(layers) / GetParam().volume, 1, 0.003);
}

TEST_P(Examples, HaveSoundContoursInEveryLayer) {
  for (const SlicedLayer& layer :
       slice(GetParam().name, {"--layer", "0.05", "--tolerance", "0"})) {
    EXPECT_TRUE(support::are_sound(layer.contours)) << "at z = " << layer.z;
  }
}

// As the page says: no island and nothing unheld is left, and the part is as it
// was.
TEST_P(Examples, AreHeldBySupports) {
  const support::TemporaryFolder folder;
  const std::string design = design_path(GetParam().name);
  const std::string held = folder.file("held.scad");
  const ProcessResult made =
      run_lamina({"supports", design, "--supports=heavy,raft", "-o", held});
  EXPECT_EQ(made.status, 0) << made.output << made.errors;
  const auto report_of = [&](const std::string& path) {
    const std::string file = folder.file("report.json");
    const ProcessResult run =
        run_lamina({path, "-q", "-o", folder.file("x.slc"), "--report", file});
    EXPECT_EQ(run.status, 0) << run.errors;
    return nlohmann::json::parse(support::read_file(file));
  };
  const auto with = report_of(held);
  const auto alone = report_of(design);
  EXPECT_NEAR((with["volume_mm3"].get<double>() -
               with["supports"]["volume_mm3"].get<double>()) /
                  alone["volume_mm3"].get<double>(),
              1, 1e-5);
  for (const auto& contact : with["supports"]["contacts"]) {
    EXPECT_FALSE(contact["is_from_above"].get<bool>());
    EXPECT_LT(contact["area_mm2"].get<double>(), 0.4);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Examples,
                         testing::Values(Design{"solitaire", 255.95, 23.999},
                                         Design{"eternity", 186.59, 3.0},
                                         Design{"signet", 947.95, 23.399},
                                         Design{"hoop", 343.10, 3.6},
                                         Design{"pendant", 232.40, 4.2},
                                         Design{"filigree", 334.61, 7.0},
                                         Design{"braid", 737.97, 5.1},
                                         Design{"medal", 414.48, 2.15}),
                         [](const testing::TestParamInfo<Design>& design) {
                           return std::string(design.param.name);
                         });

struct Ring {
  const char* name;
  double size;  // ISO: the circumference
  bool lies;
  double back;  // thickness of the shank's back, where the ring stands on it
};

// Facets stand inside the circle by less than this [mm].
constexpr double kFacetDepth = 0.02;

TEST(ExampleRings, FitTheFingerThatTheirSizeNames) {
  for (const Ring& ring :
       {Ring{"solitaire", 54, true, 1.7}, Ring{"signet", 60, true, 1.7},
        Ring{"eternity", 54, false, 0}, Ring{"filigree", 54, false, 0},
        Ring{"braid", 54, false, 0}}) {
    const double radius = ring.size / (2 * std::numbers::pi);
    const Layers layers =
        slice(ring.name, {"--layer", "0.02", "--tolerance", "0"});
    const double free = free_radius(layers, {ring.lies, radius + ring.back});
    EXPECT_LE(free, radius + 1e-3) << ring.name;
    EXPECT_GE(free, radius - kFacetDepth) << ring.name;
  }
}

TEST(ExampleRings, KnowTheSizesOfOtherCountries) {
  struct Size {
    std::string system;
    std::string size;
    double diameter;  // from the trade's conversion charts, to 0.05 mm
  };
  for (const Size& size : {Size{"US", "7", 17.32}, Size{"UK", "\"N\"", 17.12},
                           Size{"UK", "\"Q 1/2\"", 18.54},
                           Size{"CH", "14", 17.19}, Size{"JP", "14", 17.33}}) {
    const Layers layers =
        slice("eternity", {"-D", fmt::format("ring_size={}", size.size), "-D",
                           fmt::format("size_system=\"{}\"", size.system)});
    EXPECT_NEAR(2 * free_radius(layers, {}), size.diameter, 0.07)
        << size.system << " " << size.size;
  }
}

TEST(ExampleRings, RefuseSizesThatDoNotExist) {
  const support::TemporaryFolder folder;
  const ProcessResult outcome =
      run_lamina({design_path("solitaire"), "-D", "ring_size=7", "-o",
                  folder.file("out.slc")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("ISO ring size is a circumference"),
            std::string::npos)
      << outcome.errors;
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Solitaire, HasAsManyProngTipsAsItsHeadHasProngs) {
  // Half a millimetre under the top there is nothing but prongs.
  EXPECT_EQ(support::count_loops(slice_at("solitaire", 23.5).contours),
            (LoopCounts{6, 0}));
  EXPECT_EQ(support::count_loops(
                slice_at("solitaire", 23.5, {"-D", "prongs=4"}).contours),
            (LoopCounts{4, 0}));
}

TEST(Eternity, HasOneHoleForEveryStone) {
  // At half the width every culet hole cuts through the band: as many pieces
  // as stones. 25 stones of 2.3 mm go round ISO 54.
  EXPECT_EQ(support::count_loops(slice_at("eternity", 1.5).contours),
            (LoopCounts{25, 0}));
}

TEST(Signet, ShowsBorderAndInitialsInItsFace) {
  // A quarter of a millimetre under the face: the rim, and in it the field with
  // a groove for each letter.
  const double z = 60 / (2 * std::numbers::pi) + 1.7 +
                   60 / (2 * std::numbers::pi) + 2.6 - 0.25;
  EXPECT_EQ(support::count_loops(slice_at("signet", z).contours),
            (LoopCounts{2, 3}));
  EXPECT_EQ(support::count_loops(
                slice_at("signet", z, {"-D", "initials=\"I\""}).contours),
            (LoopCounts{2, 2}));
}

TEST(Signet, EngravesItsSealInMirrorImage) {
  const double z = 60 / std::numbers::pi + 1.7 + 2.6 - 0.25;
  const auto seal = slice_at("signet", z, {"-D", "initials=\"F\""});
  const auto plain =
      slice_at("signet", z, {"-D", "initials=\"F\"", "-D", "mirrored=false"});
  EXPECT_NEAR(support::total_area(seal.contours),
              support::total_area(plain.contours), 1e-6);
  // The stem of an F stands on its left.
  EXPECT_FALSE(support::contains(plain.contours, Vec2(-1.2, -1)));
  EXPECT_TRUE(support::contains(plain.contours, Vec2(1.2, -1)));
  EXPECT_TRUE(support::contains(seal.contours, Vec2(-1.2, -1)));
  EXPECT_FALSE(support::contains(seal.contours, Vec2(1.2, -1)));
}

TEST(Brilliant, WeighsWhatItsDiameterSays) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write(
      "stone.scad",
      fmt::format(
          "use <{}/lib/jewelry.scad>\nbrilliant(brilliant_diameter(1));",
          LAMINA_EXAMPLES));
  const Layers layers = slice_file(file, {"--layer", "0.01"});
  // Diamond has 3.51 g/cm³, a carat 0.2 g. The trade's rule is good to 3 or 4
  // %.
  EXPECT_NEAR(volume(layers) * 3.51e-3 / 0.2, 1, 0.04);
  for (const SlicedLayer& layer : layers) {
    EXPECT_EQ(support::count_loops(layer.contours), (LoopCounts{1, 0}));
  }
}

TEST(CastingLibrary, SetsPiecesAroundATrunk) {
  const support::TemporaryFolder folder;
  const std::string use =
      fmt::format("use <{}/lib/casting.scad>\n", LAMINA_EXAMPLES);
  const Layers disc = slice_file(folder.write("disc.scad", use + "disc(10);"),
                                 {"--layer", "0.1"});
  // Of 64 corners, 1.5 mm thick.
  const double area = 32 * 25 * std::sin(2 * std::numbers::pi / 64);
  EXPECT_NEAR(volume(disc), 1.5 * area, 1e-3);
  // Six balls 10 mm from the trunk's side, 7.07 mm above its root at 20 mm, and
  // none on the trunk, which ends at 24 mm.
  const Layers tree = slice_file(
      folder.write("tree.scad", use + "tree(6) translate([0, 0, 10]) "
                                      "sphere(1.5, $fn = 24);"),
      {"--layer", "0.1"});
  const double out = 2 + 10 * std::sqrt(0.5);
  const std::size_t level = static_cast<std::size_t>(270.7);
  ASSERT_GT(tree.size(), level);
  EXPECT_EQ(support::count_loops(tree[level].contours), (LoopCounts{6, 0}));
  EXPECT_TRUE(support::contains(tree[level].contours, Vec2(out, 0)));
  EXPECT_FALSE(support::contains(tree[level].contours, Vec2(0, 0)));
}

TEST(Hoop, HasTwoPartsInItsLowestKnuckle) {
  // The front with the pin's hole, and the back.
  EXPECT_EQ(support::count_loops(slice_at("hoop", 0.6).contours),
            (LoopCounts{2, 1}));
}

TEST(Hoop, HasAPinsHoleThroughAllKnuckles) {
  // It is 0.9 mm wide and stands at (0, -7.9); in the back half, which lies
  // beside the front, at (-4, -7.9).
  const SlicedLayer low = slice_at("hoop", 0.6);
  EXPECT_FALSE(support::contains(low.contours, Vec2(0, -7.9)));
  EXPECT_NEAR(support::distance_to_edges(low.contours, Vec2(0, -7.9)), 0.45,
              0.03);
  const SlicedLayer middle = slice_at("hoop", 1.8);
  EXPECT_NEAR(support::distance_to_edges(middle.contours, Vec2(-4, -7.9)), 0.45,
              0.03);
}

TEST(Hoop, HasAnEarPostThatCrossesTheOpening) {
  // It is 0.8 mm thick there.
  const SlicedLayer middle = slice_at("hoop", 1.8);
  EXPECT_TRUE(support::contains(middle.contours, Vec2(0, 7.9)));
  EXPECT_NEAR(support::distance_to_edges(middle.contours, Vec2(0, 7.9)), 0.4,
              0.03);
}

TEST(Pendant, LetsLightToEveryStoneThroughItsBack) {
  // 17 small stones and the centre one.
  EXPECT_EQ(support::count_loops(slice_at("pendant", 0.3).contours).holes, 18U);
}

TEST(Medal, ShowsItsNameAndDate) {
  // In the field: the rim with field and eye, the bezel, and the letter.
  const auto field = [](const std::string& letter) {
    const auto layer = slice_at(
        "medal", 1.65, {"-D", "name=\"" + letter + "\"", "-D", "name_width=6"});
    return support::count_loops(layer.contours);
  };
  EXPECT_EQ(field("T"), (LoopCounts{3, 3}));
  EXPECT_EQ(field("O"), (LoopCounts{3, 4}));
  // In the back: eye, culet hole, and the engraved line with an island.
  const auto back = slice_at("medal", 0.2, {"-D", "date=\"O\""});
  EXPECT_EQ(support::count_loops(back.contours), (LoopCounts{2, 3}));
}

TEST(Braid, ShowsACrestOfEachStrandInEveryPlait) {
  // Below the sleeve's edge there are only the crests of 3 strands in 8 plaits.
  EXPECT_EQ(support::count_loops(slice_at("braid", 0.1).contours),
            (LoopCounts{3 * 8, 0}));
}

// The table of examples/README.md.
TEST(Examples, FindWhatTheirPageSays) {
  const std::string page =
      support::read_file(fmt::format("{}/README.md", LAMINA_EXAMPLES));
  for (const std::string name : {"braid", "eternity", "filigree", "hoop",
                                 "medal", "pendant", "signet", "solitaire"}) {
    const ProcessResult result = run_lamina({"check", design_path(name)});
    EXPECT_EQ(result.status, 1);
    const std::string counts = result.output.substr(
        std::string("print: ").size(),
        result.output.find('\n') - std::string("print: ").size());
    EXPECT_NE(page.find(fmt::format("| {} | {} |", name, counts)),
              std::string::npos)
        << name << ": " << counts;
  }
}

}  // namespace
}  // namespace lamina
