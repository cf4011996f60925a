// The user's own defaults of options: ~/.config/lamina/config, lamina.conf.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;

class UserSettings : public testing::Test {
 protected:
  UserSettings() {
    for (const char* const name : {"home/.config/lamina", "other"}) {
      std::filesystem::create_directories(folder_.file(name));
    }
    folder_.write("a.scad", "cube([10, 20, 4]);");
  }

  void write_config(const std::string& text) {
    folder_.write("home/.config/lamina/config", text);
  }

  support::ProcessResult run_at_home(std::vector<std::string> words) {
    std::vector<std::string> all = {"env", "-u", "XDG_CONFIG_HOME",
                                    "HOME=" + folder_.file("home")};
    words = command(std::move(words));
    all.insert(all.end(), words.begin(), words.end());
    return support::run_process(all, folder_.path());
  }

  support::TemporaryFolder folder_;
};

TEST_F(UserSettings, TheNearerWordCounts) {
  EXPECT_TRUE(has(run_at_home({"a.scad"}).errors, "a.slc: 80 layers"));
  write_config("# mine\n layer = 0.1 # thick\n\n");
  EXPECT_TRUE(has(run_at_home({"a.scad"}).errors, "a.slc: 40 layers"));
  folder_.write("lamina.conf", "layer=0.2\n");
  EXPECT_TRUE(has(run_at_home({"a.scad"}).errors, "a.slc: 20 layers"));
  EXPECT_TRUE(has(run_at_home({"a.scad", "--layer", "0.4"}).errors,
                  "a.slc: 10 layers"));
  folder_.write("other/b.scad", "cube([10, 20, 4]);");
  EXPECT_TRUE(has(run_at_home({"other/b.scad"}).errors, "b.slc: 40 layers"));
  EXPECT_TRUE(
      has(run_at_home({"a.scad", "--root", "."}).errors, "a.slc: 80 layers"));
}

TEST_F(UserSettings, NameTheFormatWhereNoOutputDoes) {
  write_config("output = cli\n");
  EXPECT_TRUE(has(run_at_home({"a.scad"}).errors, "a.cli: 80 layers"));
  EXPECT_TRUE(
      has(run_at_home({"a.scad", "-o", "b.slc"}).errors, "b.slc: 80 layers"));
  EXPECT_TRUE(has(run_at_home({"a.scad", "-o", "b"}).errors, "b: 80 layers"));
  EXPECT_TRUE(
      has(run_at_home({"a.scad", "-o", "c/"}).errors, "c/a.cli: 80 layers"));
}

TEST_F(UserSettings, PriceWhatIsNamed) {
  write_config("price = 60 EUR/l, 2 EUR/g\n");
  EXPECT_EQ(run_at_home({"a.scad"}).status, 0);
  const auto cast = run_at_home({"a.scad", "--metal", "silver 925"});
  EXPECT_TRUE(has(cast.errors, " g of sterling silver (925), ")) << cast.errors;
  EXPECT_TRUE(has(cast.errors, " EUR")) << cast.errors;
}

TEST_F(UserSettings, AreForLayersAlone) {
  write_config("printer = elegoo-mars-3\nfail-on = all\n");
  EXPECT_EQ(run_at_home({"a.scad", "-o", "a.csg"}).status, 0);
  EXPECT_EQ(run_at_home({"a.scad", "--dump", "scene", "--at", "1"}).status, 0);
  EXPECT_EQ(run_at_home({"inspect", "a.scad"}).status, 0);
  EXPECT_TRUE(has(run_at_home({"check", "a.scad"}).output,
                  "fits: 10 x 20 x 4 mm on Elegoo Mars 3\n"));
}

TEST_F(UserSettings, SayWhereTheyAreAtFault) {
  const auto faults = [&](const std::string& text, const std::string& words) {
    write_config(text);
    const auto result = run_at_home({"a.scad"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(has(result.errors, words)) << result.errors;
  };
  faults("\nprinte = elegoo-mars-3\n",
         "config:2: there is no setting 'printe'; did you mean 'printer'?");
  faults("-o = /etc/passwd",
         "config:1: there is no setting '-o'; settings are");
  faults("layer\n", "config:1: 'layer = VALUE' was expected");
  faults("layer = thin\n", "config:1: --layer: ");
  faults("printer = nobody\n", "nobody");
}

TEST_F(UserSettings, AreListedWithTheirPlaces) {
  EXPECT_TRUE(has(run_at_home({"config"}).output, "no settings"));
  write_config("layer = 0.1\n");
  folder_.write("lamina.conf", "\nlayer = 0.2\n");
  const std::string list = run_at_home({"config", "a.scad"}).output;
  EXPECT_TRUE(has(list, "config:1\n")) << list;
  EXPECT_TRUE(has(list, "layer       = 0.2 ")) << list;
  EXPECT_TRUE(has(list, "# lamina.conf:2\n")) << list;
}

}  // namespace
}  // namespace lamina::cli
