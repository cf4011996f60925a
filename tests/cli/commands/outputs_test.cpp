// No output takes the place of an input or of another output, whatever names
// lead there; and what stands in an output's place stays what it was.

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file/file_access.h"
#include "base/file/output_file.h"
#include "base/file/run_files.h"
#include "base/file/temporary_files.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFont =
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf";

using support::has;

// A folder with one of each thing that a run can read.
class Outputs : public testing::Test {
 protected:
  Outputs() {
    folder_.write("ring.scad",
                  "size = 1; use <part.scad>\ninclude <sizes.scad>\n"
                  "use <font.ttf>\nimport(\"plan.svg\");\n"
                  "text(\"A\", font = \"Liberation Sans\");\n");
    folder_.write("part.scad", "module part() {}\n");
    folder_.write("sizes.scad", "x = 1;\n");
    folder_.write("plan.svg",
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" "
                  "height=\"9mm\" viewBox=\"0 0 9 9\"><rect width=\"5\" "
                  "height=\"5\"/></svg>");
    folder_.write("sets.json",
                  R"({"parameterSets": {"large": {"size": "2"}}})");
    folder_.write("cube.scad", "size = 1; cube(1);");
    folder_.write("ball.scad", "sphere(1);");
    folder_.write("relief.scad", "surface(\"flat.dat\");");
    folder_.write("flat.dat", "1 1\n1 1\n");
    folder_.write("torn.scad", "use <font.ttf>\ncube(");
    folder_.write("table.csv", "name,size\ncube,1\nball,2\n");
    folder_.write("links.csv", "name,size\np,1\nq,2\n");
    fs::copy_file(kFont, folder_.file("font.ttf"));
    EXPECT_EQ(run(folder_, {"cube.scad", "-o", "a.svg"}).status, 0);
    EXPECT_EQ(run(folder_, {"ball.scad", "-o", "b.svg"}).status, 0);
    fs::create_directory(folder_.file("q"));
    fs::create_symlink("q", folder_.file("p"));
    fs::create_symlink("ball.scad", folder_.file("link.slc"));
    before_ = contents();
  }

  // All files and what is in them.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      if (entry.is_regular_file()) {
        all[entry.path()] = support::read_file(entry.path());
      }
    }
    return all;
  }

  void expect_refused(const std::vector<std::string>& arguments,
                      const std::string& words) const {
    const auto result = run(folder_, arguments);
    const std::string all = fmt::format("{}", fmt::join(arguments, " "));
    EXPECT_EQ(result.status, 1) << all;
    EXPECT_TRUE(has(result.errors, words)) << all << "\n" << result.errors;
    EXPECT_TRUE(contents() == before_) << all;
  }

  const support::TemporaryFolder folder_;
  std::map<std::string, std::string> before_;
};

TEST_F(Outputs, AreNoInputs) {
  const std::vector<std::vector<std::string>> cases = {
      {"ring.scad", "-o", "ring.scad", "--export-format", "svg"},
      {"ring.scad", "-o", "./part.scad", "--export-format", "svg"},
      {"ring.scad", "-o", "p/../sizes.scad", "--export-format", "svg"},
      {"ring.scad", "-o", "plan.svg"},
      {"ring.scad", "-o", "font.ttf", "--export-format", "svg"},
      {"ring.scad", "-o", "new.svg", "-d", "sizes.scad"},
      {"ring.scad", "-o", "new.svg", "--report", "plan.svg"},
      {"ball.scad", "-o", "link.slc"},
      {"cube.scad", "-o", "new.slc", "-p", "sets.json", "-P", "large",
       "--report", "sets.json"},
      // Of texts, too, though these open none of them.
      {"ring.scad", "-o", "plan.svg", "--export-format", "csg"},
      {"ring.scad", "-o", "new.csg", "-d", "plan.svg"},
      {"ring.scad", "-o", "font.ttf", "--export-format", "csg"},
      {"ring.scad", "-o", "font.ttf", "--export-format", "ast"},
      {"ring.scad", "-o", "font.ttf", "--export-format", "param"},
      {"torn.scad", "-o", "font.ttf", "--export-format", "echo"},
      {"relief.scad", "-o", "flat.dat", "--export-format", "echo"},
      {"relief.scad", "-o", "flat.dat", "--export-format", "csg", "--root",
       "."},
      {"batch", "cube.scad", "--table", "table.csv", "-o", "{name}.slc",
       "--report", "table.csv"},
      {"batch", "cube.scad", "--table", "table.csv", "-o", "{name}.scad",
       "--export-format", "slc"},
      {"batch", "ring.scad", "--table", "table.csv", "-o", "{name}.svg",
       "--report", "plan.svg"},
      {"compare", "a.svg", "a.svg", "--report", "a.svg"},
      {"compare", "a.svg", "b.svg", "--report", "b.svg"},
  };
  for (const auto& arguments : cases) {
    expect_refused(arguments, "this run reads it, too");
  }
  for (const char* input : {"plan.svg", "font.ttf", "table.csv"}) {
    expect_refused({"batch", "ring.scad", "--table", "table.csv", "-o",
                    "{name}.svg", "--ledger", input},
                   input == std::string("plan.svg") ? "it is no ledger"
                                                    : "this run reads it, too");
  }
}

TEST_F(Outputs, AreDifferentFiles) {
  const std::vector<std::vector<std::string>> cases = {
      {"cube.scad", "-o", "new.slc", "--report", "new.slc"},
      {"cube.scad", "-o", "new.slc", "-d", "./new.slc"},
      {"cube.scad", "-o", "new.slc", "-d", "new.d", "--report", "q/../new.d"},
      {"cube.scad", "-o", "p/new.slc", "--report", "q/new.slc"},
      {"cube.scad", "ball.scad", "-o", "q/{name}.slc", "--report",
       "p/cube.slc"},
      {"compare", "a.svg", "b.svg", "--report", "new.png", "--png", "new.png"},
      {"cube.scad", "-o", "-", "--export-format", "slc", "-d", "-"},
  };
  for (const auto& arguments : cases) {
    expect_refused(arguments, "another output of this run, is the same file");
  }
  expect_refused({"batch", "cube.scad", "--table", "links.csv", "--skip",
                  "size", "-o", "{name}/x.slc"},
                 "would both write");
  expect_refused({"batch", "cube.scad", "--table", "table.csv", "-o",
                  "{name}.slc", "--report", "cube.slc"},
                 "another output of this run, is the same file");
  // Of another share of the table, too.
  for (const char* option : {"--report", "--ledger"}) {
    expect_refused({"batch", "cube.scad", "--table", "table.csv", "-o",
                    "{name}.slc", "--shard", "1/2", option, "ball.slc"},
                   "another output of this run, is the same file");
  }
  // In a folder that is not there yet.
  expect_refused({"cube.scad", "ball.scad", "-o", "new/{name}.slc", "--report",
                  folder_.file("new/cube.slc")},
                 "another output of this run, is the same file");
}

// Runs lamina with standard output at the end of a file of the folder.
support::ProcessResult run_onto(const support::TemporaryFolder& folder,
                                const std::string& file,
                                const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {
      "/bin/sh", "-c", R"(file=$1; shift; exec "$0" "$@" >> "$file")",
      LAMINA_PROGRAM, file};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return support::run_process(words, folder.path());
}

TEST_F(Outputs, MayBeStandardOutputWhateverFileThatIs) {
  folder_.write("o", "");
  fs::create_symlink("o", folder_.file("to-o"));
  before_ = contents();
  const auto expect = [&](const std::string& file,
                          const std::vector<std::string>& arguments,
                          const std::string& fault) {
    const auto result = run_onto(folder_, file, arguments);
    const std::string all = fmt::format("{}", fmt::join(arguments, " "));
    EXPECT_EQ(result.status, 1) << all;
    EXPECT_TRUE(has(result.errors, fault)) << all << "\n" << result.errors;
    EXPECT_TRUE(contents() == before_) << all;
  };
  const std::string other = "another output of this run, is the same file";
  const std::vector<std::vector<std::string>> clashes = {
      {"cube.scad", "-o", "-", "--export-format", "slc", "--report", "o"},
      {"cube.scad", "-o", "-", "--export-format", "slc", "--report", "to-o"},
      {"cube.scad", "-o", "-", "--export-format", "slc", "--report",
       "/dev/stdout"},
      {"cube.scad", "-o", "-", "--export-format", "slc", "-d", "o"},
      {"cube.scad", "-o", "-", "--export-format", "slc", "-d", "o", "--root",
       "."},
      {"cube.scad", "-o", "o", "--export-format", "slc", "--report", "-"},
      {"cube.scad", "ball.scad", "-o", "p/{name}.slc", "--report", "-"},
      {"batch", "cube.scad", "--table", "table.csv", "-o", "q/{name}.slc",
       "--report", "-"},
      {"compare", "a.svg", "a.svg", "--report", "o"},
  };
  folder_.write("q/cube.slc", "");
  before_ = contents();
  for (const auto& arguments : clashes) {
    const bool has_pieces =
        arguments[1] == "ball.scad" || arguments[0] == "batch";
    expect(has_pieces ? "q/cube.slc" : "o", arguments, other);
  }
  expect("cube.scad", {"cube.scad", "-o", "-", "--export-format", "csg"},
         "this run reads it, too");
  expect("plan.svg", {"ring.scad", "-o", "-", "--export-format", "csg"},
         "this run reads it, too");
  expect("a.svg", {"inspect", "a.svg"}, "this run reads it, too");
  expect("cube.scad", {"check", "cube.scad"}, "this run reads it, too");

  EXPECT_EQ(run_onto(folder_, "o",
                     {"cube.scad", "-o", "-", "--export-format", "csg", "-d",
                      "new.d"})
                .status,
            0);
  EXPECT_EQ(support::read_file(folder_.file("o")),
            "cube(size = [1, 1, 1], center = false);\n\n");
  // Of a run that prints nothing it is no output.
  EXPECT_EQ(run_onto(folder_, "cube.scad", {"cube.scad", "-o", "x.slc"}).status,
            0);
  EXPECT_EQ(run_onto(folder_, "o",
                     {"compare", "a.svg", "a.svg", "--report", "new.json"})
                .status,
            0);
  EXPECT_EQ(
      run_onto(folder_, "new.json",
               {"compare", "a.svg", "a.svg", "-q", "--report", "new.json"})
          .status,
      0);
}

// Links are followed, also where nothing stands yet.
TEST_F(Outputs, ThatMeetThroughALinkAreNotDifferent) {
  fs::create_symlink("later.slc", folder_.file("later.json"));
  fs::create_symlink("later.slc", folder_.file("another.slc"));
  fs::create_symlink("another.slc", folder_.file("ring.slc"));
  fs::create_symlink("new", folder_.file("old"));
  folder_.write("files.csv", "name,size\nlater,1\nring,2\n");
  folder_.write("folders.csv", "name,size\nnew,1\nold,2\n");
  before_ = contents();
  for (const std::vector<std::string>& root :
       {std::vector<std::string>(), {"--root", "."}}) {
    const auto expect = [&](std::vector<std::string> words,
                            const std::string& fault) {
      words.insert(words.end(), root.begin(), root.end());
      expect_refused(words, fault);
    };
    for (const char* option : {"--report", "-d"}) {
      expect({"cube.scad", "-o", "later.slc", option, "later.json"},
             "another output of this run, is the same file");
    }
    expect({"cube.scad", "-o", "new/x.slc", "--report", "old/x.slc"},
           "another output of this run, is the same file");
    expect({"batch", "cube.scad", "--table", "files.csv", "-o", "{name}.slc"},
           "would both write");
    expect(
        {"batch", "cube.scad", "--table", "folders.csv", "-o", "{name}/x.slc"},
        "would both write");
    expect({"batch", "cube.scad", "--table", "table.csv", "-o", "{name}.slc",
            "--ledger", "later.json", "--report", "ring.slc"},
           "another output of this run, is the same file");
  }
  // By itself such a link is written through, also one to a folder.
  for (const char* name : {"new", "root"}) {
    std::vector<std::string> words = {"cube.scad", "ball.scad", "-o",
                                      "old/{name}.slc"};
    if (name == std::string("root")) words.insert(words.end(), {"--root", "."});
    EXPECT_EQ(run(folder_, words).status, 0);
    EXPECT_TRUE(fs::exists(folder_.file("new/cube.slc")));
    fs::remove_all(folder_.file("new"));
  }
  EXPECT_EQ(run(folder_, {"cube.scad", "-o", "ring.slc"}).status, 0);
  EXPECT_TRUE(
      fs::is_regular_file(fs::symlink_status(folder_.file("later.slc"))));
  EXPECT_TRUE(fs::is_symlink(folder_.file("ring.slc")));
}

// One order's cell names what is written of the others.
TEST_F(Outputs, AreWrittenThoughAStrangersPieceTriesToReadThem) {
  folder_.write("relief.scad", "relief = \"flat.dat\"; surface(relief);");
  const auto make = [&](const std::string& cell) {
    folder_.write("t.csv", "name,relief\na,flat.dat\nb," + cell +
                               "\nc,flat.dat\nd,flat.dat\n");
    return run(folder_, {"batch", "relief.scad", "--table", "t.csv", "-o",
                         "out/{name}.slc", "--ledger", "run.ledger", "--report",
                         "run.csv", "--root", "."});
  };
  ASSERT_EQ(make("flat.dat").status, 0);
  for (const char* cell : {"run.ledger", "run.csv", "out/d.slc"}) {
    const auto result = make(cell);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(has(result.errors, "3 of 4 pieces done")) << result.errors;
    EXPECT_TRUE(has(result.errors, "this run reads it, too")) << result.errors;
    EXPECT_TRUE(has(support::read_file(folder_.file("run.csv")), "out/d.slc,2"))
        << support::read_file(folder_.file("run.csv"));
  }
}

// A ledger that the run begins is one of them.
TEST_F(Outputs, AreNoInputsFromTheMomentTheyAreMade) {
  folder_.write("read.scad", "f = \"\"; if (f != \"\") surface(f); cube(1);");
  folder_.write("read.csv", "name,f\na,\nb,new.ledger\n");
  for (const char* root : {"", "."}) {
    std::vector<std::string> words = {"batch",    "read.scad",  "--table",
                                      "read.csv", "-o",         "{name}.slc",
                                      "--ledger", "new.ledger", "--no-strict"};
    if (*root != '\0') words.insert(words.end(), {"--root", root});
    fs::remove(folder_.file("new.ledger"));
    for (int i = 0; i < 2; ++i) {
      const auto result = run(folder_, words);
      EXPECT_EQ(result.status, 1);
      EXPECT_TRUE(has(result.errors, "1 of 2 pieces done")) << result.errors;
      EXPECT_TRUE(has(result.errors, "this run reads it, too"))
          << result.errors;
    }
  }
}

TEST_F(Outputs, OfBatchesGetTheirFolders) {
  EXPECT_EQ(run(folder_, {"batch", "cube.scad", "--table", "table.csv", "-o",
                          "1/{name}.slc", "--ledger", "2/ledger", "--report",
                          "3/all.json"})
                .status,
            0);
  EXPECT_EQ(run(folder_, {"batch", "cube.scad", "--table", "table.csv", "-o",
                          "1/{name}.slc", "--collect", "2/ledger", "--report",
                          "4/all.json"})
                .status,
            0);
  EXPECT_EQ(run(folder_, {"cube.scad", "ball.scad", "-o", "1/{name}.slc",
                          "--report", "5/all.json"})
                .status,
            0);
  for (const char* file :
       {"1/ball.slc", "3/all.json", "4/all.json", "5/all.json"}) {
    EXPECT_TRUE(fs::exists(folder_.file(file))) << file;
  }
}

TEST_F(Outputs, LieInNoOther) {
  const std::vector<std::vector<std::string>> cases = {
      {"cube.scad", "-o", "new.png/", "--report", "new.png/00001.png"},
      {"cube.scad", "-o", "new.png/", "-d", "q/../new.png/index.json"},
      {"cube.scad", "-o", "new.png/x.slc", "-d", "new.png"},
      {"batch", "cube.scad", "--table", "table.csv", "-o", "out/{name}.png",
       "--ledger", "out/ball.png/00001.png"},
  };
  for (const auto& arguments : cases) {
    expect_refused(arguments, "another output of this run");
  }
}

TEST_F(Outputs, TakeNoNamesOfUnfinishedOnes) {
  folder_.write("hidden.csv", "name,size\n.b.lamina-0,1\nb,2\n");
  before_ = contents();
  const std::vector<std::vector<std::string>> cases = {
      {"cube.scad", "-o", ".a.lamina-0", "--export-format", "svg"},
      {"cube.scad", "-o", ".a.lamina-17/new.slc"},
      {"cube.scad", "-o", "2.slc", "--report", ".2.slc.lamina-0"},
      {"batch", "cube.scad", "--table", "hidden.csv", "-o", "{name}",
       "--export-format", "svg"},
  };
  for (const auto& arguments : cases) {
    expect_refused(arguments, "are kept for unfinished outputs");
  }
  // An input that is called so stays, and so does a folder of folders.
  folder_.write(".m.slc.lamina-0", "cube(1);");
  fs::create_directories(folder_.file(".m.png.lamina-0/of/mine"));
  EXPECT_EQ(run(folder_, {".m.slc.lamina-0", "-o", "m.slc"}).status, 0);
  EXPECT_EQ(run(folder_, {"cube.scad", "-o", "m.png/", "--layer", "1"}).status,
            0);
  EXPECT_TRUE(fs::exists(folder_.file(".m.slc.lamina-0")));
  fs::create_directory(folder_.file(".n.slc.lamina-0"));
  folder_.write(".n.slc.lamina-0/n.scad", "cube(1);");
  EXPECT_EQ(run(folder_, {".n.slc.lamina-0/n.scad", "-o", "n.slc"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_.file(".n.slc.lamina-0/n.scad")));
  // Such a name ends with a number.
  EXPECT_EQ(
      run(folder_, {"cube.scad", "-o", ".a.lamina-", "--export-format", "slc"})
          .status,
      0);
  EXPECT_TRUE(fs::exists(folder_.file(".m.png.lamina-0/of/mine")));
}

// The system is made to say that letters have no case.
TEST_F(Outputs, WhoseNamesDifferInCaseMayBeOne) {
  const auto run_folding = [&](const std::string& names,
                               const std::string& output) {
    folder_.write("names.csv", names);
    std::vector<std::string> words = {"env", "LD_PRELOAD=" LAMINA_FOLDING_SHIM,
                                      "ASAN_OPTIONS=verify_asan_link_order=0"};
    for (const std::string& word : command(
             {"batch", "cube.scad", "--table", "names.csv", "-o", output})) {
      words.push_back(word);
    }
    return support::run_process(words, folder_.path());
  };
  for (const char* output : {"{name}.slc", "new/{name}.slc", "{name}/x.slc"}) {
    for (const char* names :
         {"name,size\nAnna,1\nanna,2\n", "name,size\nÄnne,1\nänne,2\n"}) {
      const auto result = run_folding(names, output);
      EXPECT_EQ(result.status, 1) << names << output;
      EXPECT_TRUE(has(result.errors, "would both write")) << result.errors;
    }
  }
  EXPECT_EQ(run_folding("name,size\nAnna,1\nHanna,2\n", "{name}.slc").status,
            0);
  EXPECT_EQ(run_folding("name,size\nAnna,1\nanna,2\n", "{name}.slc").status, 1);
}

// The system may give the number of an input that is gone to an output.
TEST_F(Outputs, MayHaveTheNumberOfAnInputThatIsGone) {
  FileAccess access;
  access.report_to(std::make_shared<RunFiles>());
  TemporaryFiles files(access);
  const std::string path = folder_.file("new");
  access.run_files()->expect_output(path, access);
  for (int i = 0; i < 20; ++i) {
    const std::string name = fmt::format("input{}", i);
    const std::string input = folder_.file(name);
    folder_.write(name, "x");
    EXPECT_TRUE(access.read(input));
    fs::remove(input);
    OutputFile output = OutputFile::open(path, files);
    output.write("y");
    EXPECT_NO_THROW(output.commit());
  }
}

// What a piece has written is no input of the next one.
TEST_F(Outputs, OfAPieceAreReadByNoOther) {
  folder_.write("first.scad", "square(1);");
  folder_.write("second.scad", "import(\"out/first.svg\");");
  const auto result =
      run(folder_, {"first.scad", "second.scad", "-o", "out/{name}.svg",
                    "--export-format", "svg", "--threads", "1"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "this run reads it, too")) << result.errors;
}

TEST_F(Outputs, ThatMayNotBeWrittenStopTheOthersToo) {
  fs::create_directory(folder_.file("root"));
  folder_.write("root/cube.scad", "cube(1);");
  const auto result =
      support::run_process(command({"cube.scad", "-o", "new.slc", "--report",
                                    "../report.json", "--root", "."}),
                           folder_.file("root"));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "is outside of --root")) << result.errors;
  EXPECT_FALSE(fs::exists(folder_.file("root/new.slc")));
  EXPECT_EQ(run(folder_,
                {"cube.scad", "-o", "new.slc", "--report", "none/report.json"})
                .status,
            1);
  EXPECT_FALSE(fs::exists(folder_.file("new.slc")));
}

TEST_F(Outputs, AreWrittenAgain) {
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(run(folder_, {"cube.scad", "-o", "new.slc", "-d", "new.d",
                            "--report", "new.json"})
                  .status,
              0);
    EXPECT_EQ(run(folder_, {"cube.scad", "-o", "new.png/"}).status, 0);
  }
}

struct stat status_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status;
}

TEST_F(Outputs, KeepModeAndOwner) {
  const std::string output = folder_.file("kept.slc");
  folder_.write("kept.slc", "");
  constexpr mode_t kMode = 0640;
  ASSERT_EQ(::chmod(output.c_str(), kMode), 0);
  constexpr uid_t kOther = 1234;
  if (::geteuid() == 0) {
    ASSERT_EQ(::chown(output.c_str(), kOther, kOther), 0);
  }
  const struct stat before = status_of(output);
  ASSERT_EQ(run(folder_, {"cube.scad", "-o", "kept.slc"}).status, 0);
  const struct stat after = status_of(output);
  EXPECT_EQ(after.st_mode, before.st_mode);
  EXPECT_EQ(after.st_uid, before.st_uid);
  EXPECT_EQ(after.st_gid, before.st_gid);
  EXPECT_GT(after.st_size, 0);
}

// As the kernel has it with fs.protected_symlinks.
TEST_F(Outputs, FollowNoLinksOfStrangersWhereAllMayLeaveThem) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs links of another user";
  fs::create_directory(folder_.file("shared"));
  ASSERT_EQ(::chmod(folder_.file("shared").c_str(), 01777), 0);
  const std::string link = folder_.file("shared/out.slc");
  fs::create_symlink(folder_.file("ball.scad"), link);
  constexpr uid_t kOther = 1234;
  ASSERT_EQ(::lchown(link.c_str(), kOther, kOther), 0);
  const auto result = run(folder_, {"cube.scad", "-o", "shared/out.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors,
            "error: Can't write 'shared/out.slc': Permission denied\n");
  EXPECT_EQ(support::read_file(folder_.file("ball.scad")), "sphere(1);");
  // Nor to a folder on the way.
  const std::string folder = folder_.file("shared/way");
  fs::create_symlink(folder_.file("q"), folder);
  ASSERT_EQ(::lchown(folder.c_str(), kOther, kOther), 0);
  for (const char* const root : {"", "."}) {
    std::vector<std::string> words = {"cube.scad", "-o", "shared/way/x.slc"};
    if (*root != '\0') words.insert(words.end(), {"--root", root});
    EXPECT_EQ(run(folder_, words).status, 1);
  }
  EXPECT_FALSE(fs::exists(folder_.file("q/x.slc")));
  ASSERT_EQ(::lchown(link.c_str(), ::geteuid(), ::getegid()), 0);
  EXPECT_EQ(run(folder_, {"cube.scad", "-o", "shared/out.slc"}).status, 0);
}

// As the kernel has it with fs.protected_regular and fs.protected_fifos.
TEST_F(Outputs, TakeNothingOfFilesThatStrangersLeaveWhereAllMay) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs files of another user";
  fs::create_directory(folder_.file("shared"));
  ASSERT_EQ(::chmod(folder_.file("shared").c_str(), 01777), 0);
  folder_.write("shared/out.slc", "");
  folder_.write("shared/ledger", "");
  fs::create_directory(folder_.file("shared/out.png"));
  ASSERT_EQ(::mkfifo(folder_.file("shared/pipe").c_str(), 0666), 0);
  for (const char* name : {"out.slc", "out.png", "ledger", "pipe"}) {
    const std::string path = folder_.file("shared/" + std::string(name));
    constexpr uid_t kOther = 1234;
    ASSERT_EQ(::chmod(path.c_str(), 0777), 0);
    ASSERT_EQ(::chown(path.c_str(), kOther, kOther), 0);
  }
  for (const std::string kind : {".slc", ".png/"}) {
    for (const char* name : {"shared/out", "shared/new"}) {
      ASSERT_EQ(
          run(folder_, {"cube.scad", "-o", name + kind, "--layer", "1"}).status,
          0);
    }
    const struct stat replaced = status_of(folder_.file("shared/out" + kind));
    const struct stat fresh = status_of(folder_.file("shared/new" + kind));
    EXPECT_EQ(replaced.st_mode, fresh.st_mode);
    EXPECT_EQ(replaced.st_uid, fresh.st_uid);
    EXPECT_EQ(replaced.st_gid, fresh.st_gid);
  }
  before_ = contents();
  expect_refused({"batch", "cube.scad", "--table", "table.csv", "-o",
                  "{name}.slc", "--ledger", "shared/ledger"},
                 "Can't write 'shared/ledger': Permission denied");
  expect_refused({"cube.scad", "-o", "shared/pipe", "--export-format", "slc"},
                 "Can't write 'shared/pipe': Permission denied");
}

TEST_F(Outputs, AndInputsAreNoDevices) {
  expect_refused(
      {"batch", "cube.scad", "--table", "/dev/zero", "-o", "{row}.slc"},
      "Can't open table '/dev/zero'");
  expect_refused({"cube.scad", "-o", "new.slc", "-p", "/dev/zero", "-P", "a"},
                 "cannot open file");
}

TEST_F(Outputs, NeedADescriptor) {
  const auto result = support::run_process(
      {"/bin/sh", "-c",
       "exec 3>&-; ulimit -n 4; exec \"$0\" cube.scad -o new.slc",
       LAMINA_PROGRAM},
      folder_.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors,
            "error: Can't write 'new.slc': Too many open files\n");
}

}  // namespace
}  // namespace lamina::cli
