// Designs that come with OpenSCAD, read from the `.csg` that openscad writes of
// them: they have the layers of the design itself, to the six digits that a
// `.csg` has of each number.

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/conformance/geometry_rows.h"
#include "tests/conformance/reference.h"
#include "tests/support/openscad_cache.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

const fs::path kData = LAMINA_OPENSCAD_DATA;

// What a `.csg` does not hold, so that openscad makes something else of its
// own, too.
constexpr auto kExceptions = std::to_array<std::string_view>({
    // `use <font.ttf>`
    "testdata/scad/2D/features/text-font-symbol.scad",
    "testdata/scad/2D/features/text-font-tests.scad",
    // rands() without a seed
    "examples/Advanced/module_recursion.scad",
    // inf and nan, which are names there
    "testdata/scad/3D/features/primitive-inf-tests.scad",
    "testdata/scad/3D/issues/transform-nan-inf-tests.scad",
    // a hull of four points that six digits move out of their plane
    "testdata/scad/3D/issues/issue1089.scad",
});

bool makes_nothing(const std::string& design) {
  const support::TemporaryFolder folder;
  return support::run_process({LAMINA_PROGRAM, design, "--language", "2021",
                               "-q", "-o", folder.file("x.slc")})
             .status != 0;
}

TEST(Dumps, OfOpenScadHaveTheLayersOfTheDesign) {
  for (const std::string& name : geometry_designs(kData)) {
    if (std::ranges::find(kExceptions, name) != kExceptions.end()) continue;
    const std::string design = link_of(kData, kData / name).string();
    const support::OpenScadResult dumped =
        support::ask_openscad(kData / name, "csg");
    if (dumped.output.empty()) continue;
    const std::string dump =
        fs::path(design).replace_extension(".dump.csg").string();
    fs::copy_file(dumped.output, dump, fs::copy_options::overwrite_existing);
    const auto compared =
        support::run_process({LAMINA_PROGRAM, "compare", design, dump,
                              "--language", "2021", "--layer", "0.5"});
    if (compared.status == 0) continue;
    EXPECT_TRUE(makes_nothing(design) && makes_nothing(dump))
        << name << '\n'
        << compared.output << compared.errors;
  }
}

}  // namespace
}  // namespace lamina::conformance
