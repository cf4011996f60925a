#include "plane/order/certificate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

// No multiple of what the distances below are multiples of.
constexpr double kCoarseTie = 0.0987;

using Polyline = std::vector<Vec2>;

// From x, which both hold.
Certificate certify_chains(const Polyline& lower, const Polyline& upper,
                           double x, double limit) {
  ChainCursor a(&lower.front(), &lower.back());
  ChainCursor b(&upper.front(), &upper.back());
  a.advance(x);
  b.advance(x);
  return certify(a, b, x, limit, kCoarseTie);
}

TEST(Certificate, OfChainsThatStayApartHoldsToTheirEnd) {
  const Certificate certificate =
      certify_chains({{0, 0}, {4, 1}, {8, 0}}, {{0, 2}, {8, 2}}, 0, kNever);
  EXPECT_EQ(certificate.relation, 1);
  EXPECT_EQ(certificate.failure, kNever);
  EXPECT_EQ(certificate.valid_until, kNever);
}

TEST(Certificate, LooksNoFurtherThanTheLimit) {
  const Certificate certificate =
      certify_chains({{0, 0}, {4, 0}, {8, 0}}, {{0, 2}, {4, 2}, {8, -2}}, 0, 3);
  EXPECT_EQ(certificate.failure, kNever);
  EXPECT_EQ(certificate.valid_until, 4);
}

TEST(Certificate, FailsWhereChainsCross) {
  const Polyline lower = {{0, 0}, {8, 4}};
  const Polyline upper = {{0, 4}, {8, 0}};
  const Certificate before = certify_chains(lower, upper, 1, kNever);
  EXPECT_EQ(before.relation, 1);
  EXPECT_EQ(before.failure, 4);
  const Certificate behind = certify_chains(lower, upper, 4, kNever);
  EXPECT_EQ(behind.relation, -1);
}

TEST(Certificate, FailsWhereChainsBeginAndCeaseToTie) {
  const Polyline lower = {{0, 0}, {2, 1}, {6, 1}, {8, 0}};
  const Polyline upper = {{0, 2}, {2, 1.05}, {6, 1.05}, {8, 2}};
  EXPECT_EQ(certify_chains(lower, upper, 0, kNever).failure, 2);
  const Certificate tied = certify_chains(lower, upper, 2, kNever);
  EXPECT_EQ(tied.relation, 0);
  EXPECT_EQ(tied.failure, 6);
  EXPECT_EQ(certify_chains(lower, upper, 6, kNever).relation, 1);
}

TEST(Certificate, FailsWhereChainsTouchInAPoint) {
  const Polyline lower = {{0, 0}, {4, 2}, {8, 0}};
  const Polyline upper = {{0, 4}, {4, 2}, {8, 4}};
  const Certificate certificate = certify_chains(lower, upper, 0, kNever);
  EXPECT_EQ(certificate.relation, 1);
  EXPECT_EQ(certificate.failure, 4);
  EXPECT_EQ(certify_chains(lower, upper, 4, kNever).failure, kNever);
}

// --- Against the definition -------------------------------------------------

double y_on(const Polyline& chain, double x) {
  std::size_t i = 1;
  while (chain[i].x < x) ++i;
  const Vec2& a = chain[i - 1];
  const Vec2& b = chain[i];
  return a.y + (x - a.x) * (b.y - a.y) / (b.x - a.x);
}

// Parts of x on which both chains are straight and do not cross.
struct Part {
  double left = 0;
  double right = 0;
  int relation = 0;
  bool touches = false;  // at its left end
};

std::vector<Part> parts_of(const Polyline& lower, const Polyline& upper) {
  std::vector<double> places;
  for (const Polyline* chain : {&lower, &upper}) {
    for (const Vec2& point : *chain) places.push_back(point.x);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  const auto distance = [&](double x) {
    return y_on(upper, x) - y_on(lower, x);
  };
  std::vector<Part> parts;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double left = places[i - 1];
    const double right = places[i];
    const double a = distance(left);
    const double b = distance(right);
    if (std::abs(a) <= kCoarseTie && std::abs(b) <= kCoarseTie) {
      parts.push_back({left, right, 0, false});
    } else if (a * b < 0 && std::min(std::abs(a), std::abs(b)) > kCoarseTie) {
      const double crossing = left + (right - left) * a / (a - b);
      parts.push_back({left, crossing, a > 0 ? 1 : -1, false});
      parts.push_back({crossing, right, a > 0 ? -1 : 1, false});
    } else {
      parts.push_back({left, right, a + b >= 0 ? 1 : -1, a < 1e-9});
    }
  }
  return parts;
}

class RandomChains {
 public:
  explicit RandomChains(std::uint64_t seed) : random_(seed) {}

  // From x = 0 to 8, with vertices at whole x, and y a multiple of a quarter.
  Polyline chain() {
    Polyline points;
    for (int x = 0; x <= 8; ++x) {
      if (x > 0 && x < 8 && random_() % 2 == 0) continue;
      points.push_back({x, 0.25 * static_cast<double>(random_() % 6)});
    }
    return points;
  }
  // At a vertex or anywhere.
  double place() {
    return static_cast<double>(random_() % 8) + (random_() % 2 == 0 ? 0 : 0.37);
  }
  double limit() {
    return random_() % 2 == 0 ? kNever : static_cast<double>(random_() % 9);
  }

 private:
  std::mt19937_64 random_;
};

TEST(Certificate, OfRandomChainsKeepsItsDefinition) {
  int failures = 0;
  int swaps = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    RandomChains random(seed);
    const Polyline lower = random.chain();
    const Polyline upper = random.chain();
    const double x = random.place();
    const double limit = random.limit();
    const Certificate certificate = certify_chains(lower, upper, x, limit);
    const std::vector<Part> parts = parts_of(lower, upper);
    auto here = parts.begin();
    while (here->right <= x) ++here;
    ASSERT_EQ(certificate.relation, here->relation) << seed;
    if (here->relation < 0) {
      ++swaps;
      continue;
    }
    const auto next =
        std::find_if(here + 1, parts.end(), [&](const Part& part) {
          return part.relation != here->relation ||
                 (part.relation > 0 && part.touches);
        });
    const double failure = next == parts.end() ? kNever : next->left;
    if (certificate.failure < kNever) {
      ++failures;
      ASSERT_NEAR(certificate.failure, failure, 1e-12) << seed;
    } else {
      // It may end before the failure, but behind the limit.
      ASSERT_GT(certificate.valid_until, limit == kNever ? x : limit) << seed;
      ASSERT_LE(certificate.valid_until, failure + 1e-12) << seed;
    }
  }
  EXPECT_GT(failures, 4000);
  EXPECT_GT(swaps, 4000);
}

}  // namespace
}  // namespace lamina::plane
