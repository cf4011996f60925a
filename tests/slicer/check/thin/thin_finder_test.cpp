// Thin walls and gaps of a layer: closed formulas, laws, and a slow search that
// knows nothing but the definition.

#include "slicer/check/thin/thin_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"
#include "tests/support/random_scenes.h"

namespace lamina::slicer {
namespace {

using plane::Contours;
using support::add_loop;

using Points = std::vector<Vec2>;

Points rectangle(Vec2 low, Vec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

// The first corner on the circle lies at `phase`.
Points polygon(Vec2 centre, double radius, int corners, double phase = 0.1) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = phase + 2 * std::numbers::pi * i / corners;
    points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}

Contours contours_of(const std::vector<Points>& loops) {
  Contours contours;
  for (const Points& loop : loops) add_loop(contours, loop);
  return contours;
}

template <typename Map>
Contours mapped(Contours contours, const Map& map) {
  for (Vec2& point : contours.points) point = map(point);
  return contours;
}

Contours turned(const Contours& contours, double angle_deg) {
  const double c = std::cos(angle_deg * std::numbers::pi / 180);
  const double s = std::sin(angle_deg * std::numbers::pi / 180);
  return mapped(contours, [=](Vec2 p) {
    return Vec2(c * p.x - s * p.y, s * p.x + c * p.y);
  });
}

std::vector<ThinStretch> find(const Contours& contours, double width) {
  std::vector<ThinStretch> stretches;
  ThinFinder(width).find(contours, stretches);
  return stretches;
}

// The least width of one kind; infinite where there is none.
double least_width(const std::vector<ThinStretch>& stretches, ThinKind kind) {
  double width = std::numeric_limits<double>::infinity();
  for (const ThinStretch& stretch : stretches) {
    if (stretch.kind == kind) width = std::min(width, stretch.width);
  }
  return width;
}

std::size_t count(const std::vector<ThinStretch>& stretches, ThinKind kind) {
  return static_cast<std::size_t>(std::count_if(
      stretches.begin(), stretches.end(),
      [kind](const ThinStretch& stretch) { return stretch.kind == kind; }));
}

double total_length(const std::vector<ThinStretch>& stretches, ThinKind kind) {
  double length = 0;
  for (const ThinStretch& stretch : stretches) {
    if (stretch.kind == kind) length += glm::distance(stretch.from, stretch.to);
  }
  return length;
}

// --- Closed formulas ---------------------------------------------------------

TEST(ThinFinder, APlateIsAsThickAsItIs) {
  for (const double angle : {0.0, 37.0, 90.0, 211.0}) {
    for (const double thickness : {1e-5, 0.01, 0.19}) {
      const auto contours =
          turned(contours_of({rectangle({3, 5}, {13, 5 + thickness})}), angle);
      const auto stretches = find(contours, 0.2);
      ASSERT_EQ(stretches.size(), 1U);
      EXPECT_EQ(stretches[0].kind, ThinKind::kWall);
      EXPECT_NEAR(stretches[0].width, thickness, 1e-12);
      // All of it but where the disk leans against the ends.
      EXPECT_NEAR(glm::distance(stretches[0].from, stretches[0].to),
                  10 - thickness, 1e-7);
      EXPECT_TRUE(find(contours, thickness * 0.999).empty());
    }
  }
}

TEST(ThinFinder, AGapBetweenPlatesIsAsWideAsItIs) {
  for (const double angle : {0.0, 37.0, 90.0}) {
    for (const double gap : {1e-5, 0.01, 0.19}) {
      const auto contours =
          turned(contours_of({rectangle({0, 0}, {10, 1}),
                              rectangle({2, 1 + gap}, {15, 2})}),
                 angle);
      const auto stretches = find(contours, 0.2);
      // Between the plates, and round the corner at either end.
      ASSERT_EQ(stretches.size(), 3U);
      double length = 0;
      for (const ThinStretch& stretch : stretches) {
        EXPECT_EQ(stretch.kind, ThinKind::kGap);
        EXPECT_NEAR(stretch.width, gap, 1e-12);
        length += glm::distance(stretch.from, stretch.to);
      }
      EXPECT_GT(length, 8);
      EXPECT_LT(length, 8 + gap);
    }
  }
}

TEST(ThinFinder, ATubeIsAsThickAsItsWall) {
  // Facets of inside and outside stand parallel, or corner to facet.
  for (const double phase : {0.1, 0.1 + std::numbers::pi / 40}) {
    const auto tube = contours_of(
        {polygon({1, 2}, 5, 40), reversed(polygon({1, 2}, 4.9, 40, phase))});
    const double flat = std::cos(std::numbers::pi / 40);
    const double wall = phase == 0.1 ? 0.1 * flat : 5 * flat - 4.9;
    const auto stretches = find(tube, 0.2);
    EXPECT_NEAR(least_width(stretches, ThinKind::kWall), wall, 1e-9);
    EXPECT_EQ(count(stretches, ThinKind::kGap), 0U);
    // All the way round: every facet.
    EXPECT_GE(stretches.size(), 40U);
    EXPECT_TRUE(find(tube, wall * 0.9999).empty());
  }
}

TEST(ThinFinder, AProngIsAsThickAsItsInscribedCircle) {
  for (const int corners : {3, 4, 5, 6, 7, 8, 30, 31, 200}) {
    const double width = 0.2 * std::cos(std::numbers::pi / corners);
    const auto prong = contours_of({polygon({7, -3}, 0.1, corners)});
    const auto stretches = find(prong, 0.2);
    ASSERT_FALSE(stretches.empty()) << corners;
    for (const ThinStretch& stretch : stretches) {
      EXPECT_EQ(stretch.kind, ThinKind::kWall);
      EXPECT_NEAR(stretch.width, width, 1e-9) << corners;
      EXPECT_LT(glm::distance(stretch.place, Vec2(7, -3)), 1e-6) << corners;
    }
    EXPECT_TRUE(find(prong, width * 0.999).empty()) << corners;
  }
}

TEST(ThinFinder, AHoleIsAGap) {
  for (const int corners : {3, 4, 6, 30, 31}) {
    const auto stretches =
        find(contours_of({rectangle({0, 0}, {10, 10}),
                          reversed(polygon({4, 5}, 0.05, corners))}),
             0.2);
    ASSERT_FALSE(stretches.empty());
    EXPECT_EQ(count(stretches, ThinKind::kWall), 0U);
    EXPECT_NEAR(least_width(stretches, ThinKind::kGap),
                0.1 * std::cos(std::numbers::pi / corners), 1e-9);
  }
}

// A blade 20 mm long, whose edge may be blunt.
constexpr double kSlope = 0.05;
Contours blade(double blunt) {
  const double back = 20 * kSlope + blunt / 2;
  Points points = {{0, -back}, {20, -blunt / 2}};
  if (blunt > 0) points.push_back({20, blunt / 2});
  points.push_back({0, back});
  return contours_of({points});
}

TEST(ThinFinder, ASharpBladeIsThinUpToTheWidth) {
  const auto sharp = find(blade(0), 0.2);
  ASSERT_EQ(sharp.size(), 1U);
  EXPECT_NEAR(sharp[0].width, 0, 1e-12);
  EXPECT_LT(glm::distance(sharp[0].place, Vec2(20, 0)), 1e-9);
  // The disk of diameter 0.2 touches both sides with its centre at 20 - a.
  const double a = 0.1 * std::sqrt(1 + kSlope * kSlope) / kSlope;
  EXPECT_NEAR(glm::distance(sharp[0].from, sharp[0].to), a, 2e-5);
}

TEST(ThinFinder, ABluntBladeIsAsThinAsTheDiskAtItsEdge) {
  // The disk touches both sides and a blunt edge of 0.05.
  const auto blunt = find(blade(0.05), 0.2);
  ASSERT_EQ(blunt.size(), 1U);
  const double hypotenuse = std::sqrt(1 + kSlope * kSlope);
  const double r = 0.025 / (hypotenuse - kSlope);
  EXPECT_NEAR(blunt[0].width, 2 * r, 1e-7);
  EXPECT_LT(glm::distance(blunt[0].place, Vec2(20 - r, 0)), 1e-6);
}

TEST(ThinFinder, ASharpCornerIsThinOnlyBelowTheFacingAngle) {
  const auto wedge = [](double angle_deg) {
    const double half = angle_deg * std::numbers::pi / 360;
    return contours_of(
        {{{0, 0}, {10, -10 * std::tan(half)}, {10, 10 * std::tan(half)}}});
  };
  EXPECT_EQ(find(wedge(29), 0.2).size(), 1U);
  for (const double angle : {31.0, 60.0, 90.0, 119.0}) {
    EXPECT_TRUE(find(wedge(angle), 0.2).empty()) << angle;
  }
}

TEST(ThinFinder, ANeckBetweenCornersIsAsWideAsTheirDistance) {
  // Two triangles joined tip to tip by a neck.
  const Points neck = {{-5, -5}, {0, -0.03}, {5, -5},
                       {5, 5},   {0, 0.03},  {-5, 5}};
  const auto stretches = find(contours_of({neck}), 0.2);
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].kind, ThinKind::kWall);
  EXPECT_NEAR(stretches[0].width, 0.06, 1e-15);
}

TEST(ThinFinder, AGapBetweenCornersIsAsWideAsTheirDistance) {
  const auto gap = find(contours_of({{{-5, -5}, {-0.02, 0}, {-5, 5}},
                                     {{0.02, 0}, {5, -5}, {5, 5}}}),
                        0.2);
  ASSERT_EQ(gap.size(), 1U);
  EXPECT_EQ(gap[0].kind, ThinKind::kGap);
  EXPECT_NEAR(gap[0].width, 0.04, 1e-15);
}

TEST(ThinFinder, ACornerThatPointsAtAWallLeavesAGap) {
  const auto stretches = find(
      contours_of({rectangle({-9, -9}, {9, 0}), {{1, 0.07}, {4, 5}, {-4, 5}}}),
      0.2);
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_NEAR(stretches[0].width, 0.07, 1e-15);
  EXPECT_LT(glm::distance(stretches[0].place, Vec2(1, 0.035)), 1e-12);
}

TEST(ThinFinder, WhatStandsBetweenIsNotPassedOver) {
  // A wall 0.18 thick with a slit of 0.06 in its middle from x = 2 to 4: there
  // two walls of 0.06, beside it one of 0.18.
  const auto stretches =
      find(contours_of({rectangle({0, 0}, {10, 0.18}),
                        reversed(rectangle({2, 0.06}, {4, 0.12}))}),
           0.2);
  EXPECT_NEAR(least_width(stretches, ThinKind::kWall), 0.06, 1e-12);
  EXPECT_NEAR(least_width(stretches, ThinKind::kGap), 0.06, 1e-12);
  double whole = 0;
  for (const ThinStretch& stretch : stretches) {
    if (stretch.width > 0.17) whole += glm::distance(stretch.from, stretch.to);
    // Nowhere in the slit.
    EXPECT_TRUE(stretch.width < 0.17 || stretch.place.x < 2 ||
                stretch.place.x > 4);
  }
  EXPECT_GT(whole, 7);
}

TEST(ThinFinder, SoundPartsHaveNone) {
  EXPECT_TRUE(find(contours_of({rectangle({0, 0}, {1, 1})}), 0.2).empty());
  EXPECT_TRUE(find(contours_of({polygon({0, 0}, 3, 1000),
                                reversed(polygon({0, 0}, 2, 1000))}),
                   0.2)
                  .empty());
  // Steps and grooves shallower than the disk are no slits.
  const Points groove = {{0, 0},      {9, 0},    {9, 5}, {5.1, 5},
                         {5.1, 4.99}, {5, 4.99}, {5, 5}, {0, 5}};
  EXPECT_TRUE(find(contours_of({groove}), 0.2).empty());
  EXPECT_TRUE(find(Contours{}, 0.2).empty());
}

// --- Laws --------------------------------------------------------------------

Contours section(std::uint64_t seed, support::SceneStyle style, double z) {
  const auto layers =
      support::slice_heights(support::random_scene(seed, style, 12), {z});
  return layers.empty() ? Contours{} : layers[0].contours;
}

// Layer files may hold loops that cross themselves: what encloses nothing, once
// counted with its turns, has no middle, and what encloses next to nothing one
// that is far away.
TEST(ThinFinder, CrossedLoopsAreThinWithinTheirBoundsOrNotAtAll) {
  EXPECT_TRUE(
      find(contours_of({{{0, 0}, {4, 0}, {1, 4}, {5, 4}}}), 0.8).empty());
  const Points crossed = {{0, 0}, {4, 0}, {1, 4}, {5, 4.001}};
  const auto stretches = find(contours_of({crossed}), 0.8);
  EXPECT_FALSE(stretches.empty());
  for (const ThinStretch& stretch : stretches) {
    for (const Vec2 place : {stretch.place, stretch.from, stretch.to}) {
      EXPECT_EQ(place, glm::clamp(place, Vec2(0), Vec2(5, 4.001)));
    }
  }
}

TEST(ThinFinder, WidthsStayUnderTurnsMirrorsAndShifts) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Contours contours = section(
        seed,
        static_cast<support::SceneStyle>(seed % support::kSceneStyleCount),
        0.3);
    const auto expected = find(contours, 0.4);
    Contours mirror = mapped(contours, [](Vec2 p) { return Vec2(-p.x, p.y); });
    for (std::size_t i = 0; i < mirror.loop_count(); ++i) {
      std::reverse(mirror.points.begin() + (i == 0 ? 0 : mirror.ends[i - 1]),
                   mirror.points.begin() + mirror.ends[i]);
    }
    for (const Contours& other :
         {turned(contours, 37), mirror,
          mapped(contours, [](Vec2 p) { return p + Vec2(50, -80); })}) {
      const auto stretches = find(other, 0.4);
      for (const ThinKind kind : {ThinKind::kWall, ThinKind::kGap}) {
        const double width = least_width(expected, kind);
        if (std::isinf(width)) {
          EXPECT_EQ(count(stretches, kind), 0U) << seed;
        } else {
          EXPECT_NEAR(least_width(stretches, kind), width, 1e-6) << seed;
        }
      }
    }
  }
}

TEST(ThinFinder, WallsAndGapsChangePlacesWithSolidAndVoid) {
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    const Contours contours =
        section(seed, support::SceneStyle::kGeneric, -0.4);
    Contours inverse = contours;
    for (std::size_t i = 0; i < inverse.loop_count(); ++i) {
      std::reverse(inverse.points.begin() + (i == 0 ? 0 : inverse.ends[i - 1]),
                   inverse.points.begin() + inverse.ends[i]);
    }
    const auto a = find(contours, 0.4);
    const auto b = find(inverse, 0.4);
    EXPECT_EQ(count(a, ThinKind::kWall), count(b, ThinKind::kGap));
    EXPECT_EQ(count(a, ThinKind::kGap), count(b, ThinKind::kWall));
  }
}

// The disk between the sides y = 0 and y = 1 rolls level with the corner that
// ends its way, but for rounding. Whichever of the corner's edges comes first,
// it ends there.
TEST(ThinFinder, ADiskThatRollsTowardsACornerEndsThere) {
  Points loop = {{-2.5000120007012918, -3.4999919923722689},
                 {-1.5000120007069488, -3.4999953839064295},
                 {-1.5000001303506547, 3.4972025999283926e-16},
                 {0, 2.6645352591003761e-16},
                 {0, -0.5},
                 {4, -0.5},
                 {4, 2},
                 {0, 2},
                 {0, 0.5},
                 {-0.49999999999999967, 0.5},
                 {-0.49999999999999967, 0.99999999999999978},
                 {-1.9999999999999993, 0.99999999999999989},
                 {-1.9999999999999993, 0.50000631210482593},
                 {-2.4999984348669706, 0.50000800786659805}};
  for (std::size_t start = 0; start < loop.size(); ++start) {
    SCOPED_TRACE(start);
    const auto stretches = find(contours_of({loop}), 2);
    EXPECT_TRUE(std::ranges::any_of(stretches, [](const ThinStretch& stretch) {
      return stretch.kind == ThinKind::kWall &&
             std::abs(stretch.width - 1) < 1e-9 &&
             glm::distance(stretch.place, Vec2(-1.25, 0.5)) < 1e-6;
    }));
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  }
}

// The order of loops, and the point where each begins, number the edges anew.
TEST(ThinFinder, TheOrderOfEdgesDoesNotMatter) {
  std::mt19937_64 random(11);
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Contours contours = section(
        seed,
        static_cast<support::SceneStyle>(seed % support::kSceneStyleCount),
        0.1 * static_cast<double>(seed % 7) - 0.3);
    std::vector<Points> loops;
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      loops.emplace_back(loop.begin(), loop.end());
      const auto shift = static_cast<std::ptrdiff_t>(random() % loop.size());
      std::rotate(loops.back().begin(), loops.back().begin() + shift,
                  loops.back().end());
    }
    std::shuffle(loops.begin(), loops.end(), random);
    // Round numbers: walls and gaps of many designs are just as wide.
    for (const double width : {0.1, 0.5, 1.0, 2.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " width " << width);
      const auto a = find(contours, width);
      const auto b = find(contours_of(loops), width);
      for (const ThinKind kind : {ThinKind::kWall, ThinKind::kGap}) {
        ASSERT_EQ(count(a, kind) > 0, count(b, kind) > 0);
        if (count(a, kind) == 0) continue;
        ASSERT_NEAR(least_width(a, kind), least_width(b, kind), 1e-7);
        ASSERT_NEAR(total_length(a, kind), total_length(b, kind), 1e-5);
      }
      found += a.size();
    }
  }
  EXPECT_GT(found, 1000U);
}

// --- The definition, by trial ------------------------------------------------

struct Segment {
  Vec2 from;
  Vec2 to;
};

std::vector<Segment> segments_of(const Contours& contours) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      segments.push_back({loop[k], loop[(k + 1) % loop.size()]});
    }
  }
  return segments;
}

Vec2 nearest_point(const Segment& segment, Vec2 p) {
  const Vec2 along = segment.to - segment.from;
  const double share = std::clamp(
      glm::dot(p - segment.from, along) / glm::dot(along, along), 0.0, 1.0);
  return segment.from + share * along;
}

double clearance(const std::vector<Segment>& segments, Vec2 p) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) {
    distance = std::min(distance, glm::distance(p, nearest_point(segment, p)));
  }
  return distance;
}

// The largest empty disk that touches the boundary at p, on the side of the
// unit normal: no value if `width` fits, or if what it touches does not face p.
struct Disk {
  Vec2 centre = Vec2(0);
  double radius = 0;
};
std::optional<Disk> facing_disk(const std::vector<Segment>& segments, Vec2 p,
                                Vec2 normal, double width) {
  const auto fits = [&](double r) {
    return clearance(segments, p + r * normal) > r - 1e-9;
  };
  double low = 0;
  double high = width / 2;
  if (fits(high)) return std::nullopt;
  for (int i = 0; i < 50; ++i) {
    const double r = (low + high) / 2;
    (fits(r) ? low : high) = r;
  }
  const Vec2 centre = p + low * normal;
  for (const Segment& segment : segments) {
    const Vec2 q = nearest_point(segment, centre);
    if (glm::distance(q, centre) > low + 1e-8) continue;
    const double cosine =
        glm::dot(p - centre, q - centre) / (low * glm::distance(q, centre));
    // Clearly beyond the limit, which rounding may put on either side.
    if (cosine < -std::cos(kFacingAngle * 0.98)) return Disk{centre, low};
  }
  return std::nullopt;
}

bool is_found(const std::vector<ThinStretch>& stretches, ThinKind kind,
              const Disk& disk) {
  return std::any_of(
      stretches.begin(), stretches.end(), [&](const ThinStretch& stretch) {
        const Segment line{stretch.from, stretch.to};
        const Vec2 nearest = stretch.from == stretch.to
                                 ? stretch.from
                                 : nearest_point(line, disk.centre);
        return stretch.kind == kind &&
               stretch.width <= 2 * disk.radius + 1e-6 &&
               glm::distance(nearest, disk.centre) <= 0.1 * disk.radius + 1e-6;
      });
}

void expect_complete(const Contours& contours,
                     const std::vector<ThinStretch>& stretches, double width,
                     std::mt19937_64& random, int tries) {
  const std::vector<Segment> segments = segments_of(contours);
  std::uniform_real_distribution<double> share(0.001, 0.999);
  for (int i = 0; i < tries; ++i) {
    const Segment& segment = segments[random() % segments.size()];
    const Vec2 along = segment.to - segment.from;
    const Vec2 p = segment.from + share(random) * along;
    const Vec2 left = Vec2(-along.y, along.x) / glm::length(along);
    for (const ThinKind kind : {ThinKind::kWall, ThinKind::kGap}) {
      const auto disk = facing_disk(
          segments, p, kind == ThinKind::kWall ? left : -left, width * 0.9999);
      if (!disk || disk->radius < 1e-4) continue;
      ASSERT_TRUE(is_found(stretches, kind, *disk))
          << "at " << p.x << ' ' << p.y << ", width " << 2 * disk->radius;
    }
  }
}

void expect_true(const Contours& contours,
                 const std::vector<ThinStretch>& stretches, double width) {
  const std::vector<Segment> segments = segments_of(contours);
  for (const ThinStretch& stretch : stretches) {
    ASSERT_LT(stretch.width, width);
    // Loops that are thin as a whole touch nothing.
    if (stretch.sides[0] == stretch.sides[1] && stretch.width > 0) continue;
    const double r = stretch.width / 2;
    ASSERT_GE(clearance(segments, stretch.place), r - 2e-8);
    for (const Vec2 side : stretch.sides) {
      ASSERT_NEAR(glm::distance(side, stretch.place), r, 1e-8);
      ASSERT_LT(clearance(segments, side), 1e-8);
    }
    if (r > 1e-5) {
      ASSERT_EQ(support::contains(contours, stretch.place),
                stretch.kind == ThinKind::kWall);
      ASSERT_LE(glm::dot(stretch.sides[0] - stretch.place,
                         stretch.sides[1] - stretch.place),
                -r * r * (std::cos(kFacingAngle) - 1e-3));
    }
  }
}

TEST(ThinFinder, AgreesWithTheDefinitionOnRandomSections) {
  std::mt19937_64 random(7);
  std::size_t found = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const Contours contours = section(
        seed,
        static_cast<support::SceneStyle>(seed % support::kSceneStyleCount),
        0.1 * static_cast<double>(seed % 7) - 0.3);
    if (contours.is_empty()) continue;
    for (const double width : {0.1, 0.5, 2.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " width " << width);
      const auto stretches = find(contours, width);
      found += stretches.size();
      expect_true(contours, stretches, width);
      expect_complete(contours, stretches, width, random, 100);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace lamina::slicer
