// Runs bench/agreement over a folder of small designs, one for each way in
// which layers and openscad's mesh of the same design can differ, or seem to.
// The first line of a design says what the script must find.

#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

const fs::path kDesigns =
    fs::path(LAMINA_SOURCES) / "tests/conformance/agreement";

// What the first lines say, by the design's name.
std::map<std::string, std::string> expected() {
  std::map<std::string, std::string> all;
  for (const fs::directory_entry& entry : fs::directory_iterator(kDesigns)) {
    const std::string text = support::read_file(entry.path().string());
    all[entry.path().filename().string()] =
        text.substr(3, text.find('\n') - 3);  // after "// "
  }
  return all;
}

TEST(Agreement, FindsOfEachDesignWhatItsFirstLineSays) {
  const support::TemporaryFolder folder;
  const std::string list = folder.file("list");
  const support::ProcessResult result = support::run_process(
      {"env", "LAMINA=" LAMINA_PROGRAM, LAMINA_SOURCES "/bench/agreement",
       kDesigns.string(), "--list", list});
  EXPECT_EQ(result.status, 0) << result.output << result.errors;
  std::map<std::string, std::string> found;
  std::istringstream lines(support::read_file(list));
  for (std::string line; std::getline(lines, line);) {
    const auto row = nlohmann::json::parse(line);
    found[row["design"]] = row["became"];
  }
  EXPECT_EQ(found, expected()) << result.output;
}

}  // namespace
}  // namespace lamina::conformance
