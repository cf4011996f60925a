#pragma once
// Runs both programs on the same designs: they must write the same bytes.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {

using Words = std::vector<std::string>;

inline std::string show(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

// A folder of designs in which both programs run.
class BothPrograms : public testing::Test {
 protected:
  // What `program` writes into `output`, one of the files that `arguments`
  // name.
  std::string run(const std::string& program, Words arguments,
                  const std::string& output) {
    std::filesystem::remove(folder_.file(output));
    arguments.insert(arguments.begin(), program);
    support::run_process(arguments, folder_.path());
    return std::filesystem::exists(folder_.file(output))
               ? support::read_file(folder_.file(output))
               : "(no file)";
  }

  void expect_same(const Words& arguments, const std::string& output) {
    const std::string theirs = run("openscad", arguments, output);
    EXPECT_EQ(run(LAMINA_PROGRAM, arguments, output), theirs)
        << show(arguments);
    EXPECT_NE(theirs, "(no file)") << show(arguments);
  }

  void expect_same_echo(Words arguments, const std::string& design) {
    arguments.insert(arguments.end(), {"-o", "out.echo", design});
    expect_same(arguments, "out.echo");
  }

  support::TemporaryFolder folder_;
};

}  // namespace lamina::conformance
