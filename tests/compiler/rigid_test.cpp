// `$rigid`: what keeps its size where --scale changes that of the rest.

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "tests/support/temporary_folder.h"

namespace lamina::compiler {
namespace {

using support::TemporaryFolder;

// A length that is equal for a goldsmith, and for the arithmetic [mm].
constexpr double kEqual = 1e-9;

struct Lowering {
  TemporaryFiles files;
  Compilation compilation;
  std::optional<csg::Lowered> lowered;

  Lowering(const std::string& path, Vec3 scale)
      : compilation(request_of(path, scale), files),
        lowered(make_geometry(compilation)) {}

  static Request request_of(const std::string& path, Vec3 scale) {
    Request request;
    request.design.path = path;
    request.geometry.scale = scale;
    return request;
  }

  const csg::Scene& scene() const { return *lowered->scene(); }
  std::vector<std::string> messages() const {
    std::vector<std::string> all;
    for (const Diagnostic& one : compilation.diagnostics.all()) {
      all.push_back(one.message);
    }
    return all;
  }
};

bool is_called_by(const csg::Instance& instance, std::string_view module) {
  for (auto* call = instance.caller; call != nullptr; call = call->caller) {
    if (call->name == module) return true;
  }
  return false;
}

// Instances of a design as it is and as it is scaled.
struct Pair {
  const csg::Instance& as_is;
  const csg::Instance& scaled;

  Vec3 shift() const {
    return scaled.world_from_leaf[3] - as_is.world_from_leaf[3];
  }
  bool keeps_size() const {
    for (int i = 0; i < 3; ++i) {
      if (glm::length(scaled.world_from_leaf[i] - as_is.world_from_leaf[i]) >
          kEqual) {
        return false;
      }
    }
    return true;
  }
  bool is_scaled_by(Vec3 scale) const {
    for (int i = 0; i < 4; ++i) {
      if (glm::length(scaled.world_from_leaf[i] -
                      scale * as_is.world_from_leaf[i]) > kEqual) {
        return false;
      }
    }
    return true;
  }
};

// In all of them the seats alone keep their size. Returns how far the leaves
// of each seat move, one after the other.
std::vector<Vec3> shifts_of_seats(const std::string& example, Vec3 scale) {
  const std::string path = LAMINA_EXAMPLES + ("/" + example + ".scad");
  const Lowering as_is(path, Vec3(1));
  const Lowering scaled(path, scale);
  std::vector<Vec3> shifts;
  const auto& instances = as_is.scene().instances;
  EXPECT_EQ(instances.size(), scaled.scene().instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Pair pair = {instances[i], scaled.scene().instances[i]};
    if (is_called_by(pair.as_is, "seat_cutter")) {
      EXPECT_TRUE(pair.keeps_size()) << example;
      shifts.push_back(pair.shift());
    } else {
      EXPECT_TRUE(pair.is_scaled_by(scale)) << example;
    }
  }
  return shifts;
}

TEST(Rigid, SeatOfSolitaireMovesWithItsStone) {
  const Vec3 scale(1.02, 1.03, 0.985);
  const auto shifts = shifts_of_seats("solitaire", scale);
  ASSERT_FALSE(shifts.empty());
  for (const Vec3 shift : shifts) {
    EXPECT_LT(glm::length(shift - shifts[0]), kEqual);
    // The stone is above the finger's axis.
    EXPECT_NEAR(shift.x, 0, kEqual);
    EXPECT_NEAR(shift.y, 0, kEqual);
  }
  // The bed is a shank of 1.7 mm below the hole of size 54, and the girdle
  // 0.7 mm and the culet's depth of a carat above it.
  const double stone = std::cbrt(1 / 0.0037);
  const double culet = (0.025 / 2 + 0.43) * stone;
  const double girdle = 1.7 + 54 / std::numbers::pi + 0.7 + culet;
  EXPECT_NEAR(shifts[0].z, (scale.z - 1) * girdle, kEqual);
}

TEST(Rigid, SeatsOfEternityMoveOutwards) {
  const auto shifts = shifts_of_seats("eternity", Vec3(1.02));
  ASSERT_GT(shifts.size(), 20U);
  // All girdles are as far from the axis of the finger, which is above the
  // bed by what the band measures there.
  const double out = glm::length(shifts[0] - shifts[1]);
  EXPECT_LT(out, 1);
  Vec3 sum(0);
  for (const Vec3 shift : shifts) sum += shift;
  const Vec3 middle = sum / static_cast<double>(shifts.size());
  for (const Vec3 shift : shifts) {
    EXPECT_NEAR(glm::length(shift - middle), glm::length(shifts[0] - middle),
                kEqual);
  }
}

// A seat stands where these say, and has this frame.
struct Seat {
  const char* text;
  Vec3 place;
};

TEST(Rigid, OriginOfTheOutermostCallMoves) {
  const TemporaryFolder folder;
  const std::string modules =
      "module seat() { translate([0, 0, 3]) cube(1); cylinder(r = 1, h = 4); "
      "}\n"
      "module at() translate([10, 0, 0]) children();\n"
      "module pair() { seat(); translate([0, 5, 0]) seat(); }\n";
  const Vec3 scale(1.1, 0.9, 1.5);
  const std::vector<Seat> seats = {
      {"translate([10, 20, 30]) seat($rigid = true);", {10, 20, 30}},
      {"translate([10, 20, 30]) rotate([20, 30, 40]) seat($rigid = true);",
       {10, 20, 30}},
      {"mirror([1, 0, 0]) translate([10, 20, 30]) seat($rigid = true);",
       {-10, 20, 30}},
      {"at() seat($rigid = true);", {10, 0, 0}},
      {"translate([0, 20, 0]) pair($rigid = true);", {0, 20, 0}},
      {"$rigid = true; translate([0, 20, 0]) sphere(2);", {0, 20, 0}},
      {"$rigid = true; color(\"red\") translate([0, 20, 0]) cube(2);",
       {0, 20, 0}},
      {"$rigid = true; for (i = [0 : 0]) translate([7, 0, 0]) seat();",
       {7, 0, 0}},
      {"$rigid = true; if (true) let (a = 1) translate([7, 0, 0]) seat();",
       {7, 0, 0}},
      {"translate([0, 0, 9]) hull($rigid = true) { seat(); cube(7); }",
       {0, 0, 9}},
      {"translate([0, 0, 9]) linear_extrude(2, $rigid = true) square(3);",
       {0, 0, 9}},
  };
  for (const Seat& seat : seats) {
    const auto path = folder.write("a.scad", modules + seat.text);
    const Lowering as_is(path, Vec3(1));
    const Lowering scaled(path, scale);
    EXPECT_TRUE(scaled.messages().empty()) << seat.text;
    const auto& instances = as_is.scene().instances;
    ASSERT_EQ(instances.size(), scaled.scene().instances.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
      const Pair pair = {instances[i], scaled.scene().instances[i]};
      EXPECT_TRUE(pair.keeps_size()) << seat.text;
      EXPECT_LT(glm::length(pair.shift() - (scale - 1.0) * seat.place), kEqual)
          << seat.text;
    }
  }
}

TEST(Rigid, TurnedDesignsScaleAlongTheAxesOfThePrint) {
  const TemporaryFolder folder;
  const auto path = folder.write(
      "a.scad", "translate([1, 2, 3]) cube(2, $rigid = true); cube(1);");
  auto request = Lowering::request_of(path, Vec3(1.1, 1.2, 1.3));
  request.geometry.up = Vec3(1, 2, 3);
  TemporaryFiles files;
  Compilation turned(request, files);
  request.geometry.scale = Vec3(1);
  Compilation plain(request, files);
  const auto scaled = make_geometry(turned);
  const auto as_is = make_geometry(plain);
  const Pair rigid = {as_is->scene()->instances[0],
                      scaled->scene()->instances[0]};
  EXPECT_TRUE(rigid.keeps_size());
  EXPECT_LT(glm::length(rigid.shift() -
                        Vec3(0.1, 0.2, 0.3) * rigid.as_is.world_from_leaf[3]),
            kEqual);
  const Pair rest = {as_is->scene()->instances[1],
                     scaled->scene()->instances[1]};
  EXPECT_TRUE(rest.is_scaled_by(Vec3(1.1, 1.2, 1.3)));
}

TEST(Rigid, WhatCannotKeepItsSizeIsWarnedOf) {
  const TemporaryFolder folder;
  for (const char* text :
       {"hull() { cube(1); translate([5, 0, 0]) cube(1, $rigid = true); }",
        "linear_extrude(1) circle(2, $rigid = true);",
        "minkowski() { cube(3); sphere(1, $rigid = true); }"}) {
    const Lowering scaled(folder.write("a.scad", text), Vec3(2));
    ASSERT_EQ(scaled.messages().size(), 1U) << text;
    EXPECT_TRUE(scaled.messages()[0].starts_with("$rigid does nothing"));
    const Lowering as_is(folder.write("a.scad", text), Vec3(1));
    EXPECT_TRUE(as_is.messages().empty()) << text;
  }
}

}  // namespace
}  // namespace lamina::compiler
