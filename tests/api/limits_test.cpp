// The program and the library refuse the same: what an option may be, and what
// excludes what.

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <lamina/design.h>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace {

struct Asked {
  lamina::DesignOptions design;
  lamina::SliceOptions slice;
  lamina::InspectOptions inspect;
  lamina::ImageOptions images;
  std::string output = "a.slc";
};

// The same request in both languages.
struct Case {
  std::vector<std::string> options;
  std::function<void(Asked&)> ask;
  bool is_fine = false;
  std::string name;  // in what the library says
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {{"--layer", "0"},
       [](Asked& a) { a.slice.layer_thickness = 0; },
       false,
       "layer_thickness"},
      {{"--layer", "-1"},
       [](Asked& a) { a.slice.layer_thickness = -1; },
       false,
       "layer_thickness"},
      {{"--layer", "0.5"},
       [](Asked& a) { a.slice.layer_thickness = 0.5; },
       true,
       ""},
      {{"--adaptive", "-1"},
       [](Asked& a) { a.slice.adaptive = -1; },
       false,
       "adaptive"},
      {{"--max-layer", "0.2"},
       [](Asked& a) { a.slice.max_layer = 0.2; },
       false,
       "max_layer needs adaptive"},
      {{"--adaptive", "0.05", "--max-layer", "0.01"},
       [](Asked& a) {
         a.slice.adaptive = 0.05;
         a.slice.max_layer = 0.01;
       },
       false,
       "max_layer must not be less than layer_thickness"},
      {{"--adaptive", "0.05", "--heights", "0.5"},
       [](Asked& a) {
         a.slice.adaptive = 0.05;
         a.slice.heights = {0.5};
       },
       false,
       "adaptive and heights"},
      {{"--heights", "0.5,0.5"},
       [](Asked& a) {
         a.slice.heights = {0.5, 0.5};
       },
       false,
       "heights must rise"},
      {{"--tolerance", "-0.1"},
       [](Asked& a) { a.slice.tolerance = -0.1; },
       false,
       "tolerance"},
      {{"--tolerance", "0"}, [](Asked& a) { a.slice.tolerance = 0; }, true, ""},
      {{"--compensate", "-100.5"},
       [](Asked& a) { a.slice.compensation = -100.5; },
       false,
       "compensation"},
      {{"--compensate", "-0.1"},
       [](Asked& a) { a.slice.compensation = -0.1; },
       true,
       ""},
      {{"--threads", "1025"},
       [](Asked& a) { a.slice.threads = 1025; },
       false,
       "threads"},
      {{"--scale", "0.0009"},
       [](Asked& a) { a.design.scale = 0.0009; },
       false,
       "scale"},
      {{"--scale", "1001"},
       [](Asked& a) { a.design.scale = 1001; },
       false,
       "scale"},
      {{"--scale", "1000"}, [](Asked& a) { a.design.scale = 1000; }, true, ""},
      {{"--chordal-error", "0.0000001"},
       [](Asked& a) { a.design.chordal_error = 1e-7; },
       false,
       "chordal_error"},
      {{"--chordal-error", "0.000001"},
       [](Asked& a) { a.design.chordal_error = 1e-6; },
       true,
       ""},
      {{"--axis", "up"}, [](Asked& a) { a.design.axis = "up"; }, false, "axis"},
      {{"--axis", "-x"}, [](Asked& a) { a.design.axis = "-x"; }, true, ""},
      {{"--language", "2019"},
       [](Asked& a) { a.design.language = "2019"; },
       false,
       "language"},
      {{"--max-depth", "300001"},
       [](Asked& a) { a.design.max_depth = 300001; },
       false,
       "max_depth"},
      {{"--max-depth", "0"},
       [](Asked& a) { a.design.max_depth = 0; },
       false,
       "max_depth"},
      {{"--max-leaves", "1000000001"},
       [](Asked& a) { a.design.max_leaves = 1000000001; },
       false,
       "max_leaves"},
      {{"--min-feature", "0.0009"},
       [](Asked& a) { a.inspect.min_feature = 0.0009; },
       false,
       "min_feature"},
      {{"--min-feature", "10"},
       [](Asked& a) { a.inspect.min_feature = 10; },
       true,
       ""},
      {{"--mirror", "x"},
       [](Asked& a) { a.images.mirror_x = true; },
       false,
       "mirror needs images"},
      {{"--heights", "0.5", "-o", "a.sl1"},
       [](Asked& a) {
         a.slice.heights = {0.5};
         a.output = "a.sl1";
       },
       false,
       "layers of one thickness, not heights or adaptive"},
  };
  return all;
}

TEST(Limits, AreThoseOfTheProgram) {
  const lamina::support::TemporaryFolder folder;
  const std::string path = folder.write("a.scad", "cube(1);");
  for (const Case& one : cases()) {
    std::vector<std::string> words = {LAMINA_PROGRAM, path, "-q"};
    words.insert(words.end(), one.options.begin(), one.options.end());
    const auto program = lamina::support::run_process(words, folder.path());
    EXPECT_EQ(program.status, one.is_fine ? 0 : 2)
        << one.options[0] << ' ' << one.options[1] << '\n'
        << program.errors;

    Asked asked;
    one.ask(asked);
    std::string fault;
    try {
      const auto design = lamina::Design::from_file(path, asked.design);
      if (asked.inspect.min_feature != 0) {
        design.inspect(asked.slice, asked.inspect);
      }
      design.write(folder.file(asked.output), asked.slice, asked.images);
    } catch (const std::runtime_error& error) {
      fault = error.what();
    }
    EXPECT_EQ(fault.empty(), one.is_fine) << one.options[0] << '\n' << fault;
    EXPECT_NE(fault.find(one.name), std::string::npos) << fault;
  }
}

}  // namespace
