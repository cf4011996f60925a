// Booleans of random regions, judged point by point with winding numbers of
// the operands.
//
// LAMINA_RANDOM_REGIONS=N  rounds (300)

#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "tests/plane/region/lattice_walks.h"
#include "tests/support/environment.h"

namespace lamina::plane {
namespace {

int winding_number(const std::vector<Contour>& contours, Vec2 p) {
  int sum = 0;
  for (const Contour& contour : contours) {
    sum += lamina::winding_number(contour, p);
  }
  return sum;
}

bool is_near(const std::vector<Contour>& contours, Vec2 p, double distance) {
  for (const Contour& contour : contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      if (distance_to_segment(p, contour[i],
                              contour[(i + 1) % contour.size()]) < distance) {
        return true;
      }
    }
  }
  return false;
}

// Polygons of one kind: of anywhere, stars of thin spikes, walks on a lattice,
// the same turned.
class RandomContours {
 public:
  explicit RandomContours(std::uint64_t seed) : random_(seed) {}

  std::vector<Contour> make(std::uint64_t seed) {
    switch (seed % 4) {
      case 0:
        return {anywhere(3 + random_() % 12), anywhere(3 + random_() % 12)};
      case 1:
        return {star(), star()};
      case 2:
        return lattice_walks(static_cast<unsigned>(random_()));
      default:
        break;
    }
    auto walks = lattice_walks(static_cast<unsigned>(random_()));
    // The same for all operands of a round: their edges coincide.
    const double c = std::cos(static_cast<double>(seed));
    const double s = std::sin(static_cast<double>(seed));
    for (Contour& walk : walks) {
      for (Vec2& p : walk) p = {c * p.x - s * p.y, s * p.x + c * p.y};
    }
    return walks;
  }

  Vec2 point() { return {coordinate_(random_), coordinate_(random_)}; }

 private:
  Contour anywhere(std::size_t count) {
    Contour contour;
    for (std::size_t i = 0; i < count; ++i) contour.push_back(point());
    return contour;
  }
  Contour star() {
    const Vec2 center = point();
    const int count = 20;
    Contour contour;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      const double r = i % 2 == 0 ? 5 : 0.1;
      contour.push_back(center + r * Vec2(std::cos(angle), std::sin(angle)));
    }
    return contour;
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> coordinate_{-8, 8};
};

struct Tally {
  std::uint64_t probes = 0;
  std::uint64_t failures = 0;
};

class Judge {
 public:
  Judge(std::uint64_t seed, double scale, Tally& tally)
      : seed_(seed), scale_(scale), tally_(tally), contours_(seed) {
    for (auto& operand : operands_) {
      operand = contours_.make(seed);
      for (Contour& contour : operand) {
        for (Vec2& p : contour) p *= scale;
      }
    }
  }

  void judge() {
    std::vector<Region> regions;
    for (const auto& operand : operands_) {
      regions.push_back(from_contours(operand, FillRule::kNonZero));
    }
    const Region odd = from_contours(operands_[0], FillRule::kEvenOdd);
    const Region all = unite(regions);
    const Region common = intersect(regions);
    const Region rest = subtract(regions);
    const Region clipped = clip(operands_[0], regions[1]);
    for (int i = 0; i < 400; ++i) {
      const Vec2 p = scale_ * contours_.point();
      if (is_any_near(p)) continue;
      std::array<bool, 3> is_in{};
      for (std::size_t k = 0; k < 3; ++k) {
        is_in[k] = winding_number(operands_[k], p) != 0;
        expect(regions[k], p, is_in[k], "an operand");
      }
      const auto [a, b, c] = is_in;
      expect(odd, p, winding_number(operands_[0], p) % 2 != 0, "odd");
      expect(all, p, a || b || c, "union");
      expect(common, p, a && b && c, "intersection");
      expect(rest, p, a && !b && !c, "difference");
      expect(clipped, p, a && b, "clip");
    }
  }

 private:
  bool is_any_near(Vec2 p) const {
    for (const auto& operand : operands_) {
      if (is_near(operand, p, 1e-6 * scale_)) return true;
    }
    return false;
  }
  void expect(const Region& region, Vec2 p, bool is_in,
              const std::string& what) {
    ++tally_.probes;
    const int winding = winding_number(region.contours, p);
    if (winding == (is_in ? 1 : 0)) return;
    ++tally_.failures;
    ADD_FAILURE() << "seed " << seed_ << ", scale " << scale_ << ", " << what
                  << " at " << p.x << ", " << p.y << ": " << winding;
  }

  const std::uint64_t seed_;
  const double scale_;
  Tally& tally_;
  RandomContours contours_;
  std::array<std::vector<Contour>, 3> operands_;
};

TEST(RandomRegions, HoldWhatTheirOperandsHold) {
  const std::uint64_t count =
      support::number_from("LAMINA_RANDOM_REGIONS", 300);
  Tally tally;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    for (const double scale : {1e-2, 1.0, 1e5}) {
      Judge(seed, scale, tally).judge();
    }
  }
  std::cout << tally.probes << " probes, " << tally.failures << " failures\n";
  EXPECT_EQ(tally.failures, 0U);
}

}  // namespace
}  // namespace lamina::plane
