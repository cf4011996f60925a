// examples/scan_ring.scad with Stanford's bunny, which scripts/fetch_bunny
// keeps in the tests' cache.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/openscad_cache.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina {
namespace {

using Options = std::vector<std::string>;

class ScanRing : public testing::Test {
 protected:
  void SetUp() override {
    const auto fetched = support::run_process({LAMINA_FETCH_BUNNY, bunny_});
    ASSERT_EQ(fetched.status, 0) << fetched.errors;
  }

  // What inspect finds in the ring.
  nlohmann::json inspected(const Options& options) const {
    Options words = {LAMINA_PROGRAM,
                     "inspect",
                     "--json",
                     "--hardwarnings",
                     "-q",
                     "-D",
                     fmt::format("scan=\"{}\"", bunny_),
                     LAMINA_EXAMPLES "/scan_ring.scad"};
    words.insert(words.end(), options.begin(), options.end());
    const auto result = support::run_process(words);
    EXPECT_EQ(result.status, 0) << result.errors;
    return nlohmann::json::parse(result.output);
  }

  const std::string bunny_ = (support::cache_folder() / "bunny.ply").string();
};

TEST_F(ScanRing, HasTheSizeThatItsParametersSay) {
  const nlohmann::json ring = inspected({});
  EXPECT_EQ(ring.at("defects"), 0);
  // Finger, shank above and below, plate, and the scan, sunk by 0.2 mm.
  const double diameter = 56 / 3.14159265;
  EXPECT_NEAR(ring.at("top_mm").get<double>(),
              diameter + 2 * 1.8 + 0.9 - 0.2 + 9, 0.06);
  EXPECT_NEAR(ring.at("box_mm").at("low")[2].get<double>(), 0, 0.06);
}

TEST_F(ScanRing, IsEngravedAsDeepAsItSays) {
  const double plain =
      inspected({"-D", "initials=\"\""}).at("volume_mm3").get<double>();
  const double shallow = inspected({"-D", "depth=0.3"}).at("volume_mm3");
  const double deep = inspected({"-D", "depth=0.6"}).at("volume_mm3");
  EXPECT_GT(plain - shallow, 0.2);
  // The cut follows the surface, so what is taken out grows with its depth.
  EXPECT_NEAR((plain - deep) / (plain - shallow), 2, 0.3);
}

TEST_F(ScanRing, IsTheSameWithinTheToleranceWhereTheScanIsDecimated) {
  const nlohmann::json whole = inspected({"-D", "decimate=0"});
  const nlohmann::json thinned = inspected({"-D", "decimate=0.05"});
  const double volume = whole.at("volume_mm3");
  EXPECT_NE(thinned.at("volume_mm3").get<double>(), volume);
  // Of some 200 mm².
  EXPECT_NEAR(thinned.at("volume_mm3").get<double>(), volume, 0.05 * 200);
}

}  // namespace
}  // namespace lamina
