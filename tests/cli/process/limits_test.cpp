// What a run may take: time, memory, and what a design may ask for.

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/child_process.h"
#include "cli/options/common_options.h"
#include "cli/process/machine_memory.h"
#include "cli/process/process_watch.h"
#include "compiler/validate.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using support::has;
using support::ProcessResult;
using support::TemporaryFolder;

// Nothing but the design is in its folder.
void expect_no_output(const TemporaryFolder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_EQ(entry.path().extension(), ".scad") << entry.path();
  }
}

// Takes more than a minute, and no memory.
constexpr const char* kEndless =
    "function f(n) = n == 0 ? 0 : let(s = f(n - 1)) s + f(n - 1);"
    "echo(f(60)); cube(1);";

// Takes all memory that there is.
constexpr const char* kHungry =
    "function grow(s, n) = n == 0 ? s : grow(str(s, s), n - 1);"
    "echo(len(grow(\"0123456789\", 60))); cube(1);";

// --- The options -------------------------------------------------------------

TEST(MemoryLimit, HasUnitsOf1024) {
  EXPECT_EQ(parse_memory_limit("123456789").bytes, 123456789U);
  EXPECT_EQ(parse_memory_limit("800k").bytes, 800U << 10);
  EXPECT_EQ(parse_memory_limit("500M").bytes, 500U << 20);
  EXPECT_EQ(parse_memory_limit("1.5G").bytes, 3U << 29);
  EXPECT_EQ(parse_memory_limit("2g").bytes, std::uint64_t{2} << 30);
}

TEST(MemoryLimit, MayBeAShareOfTheMachine) {
  const MemoryLimit limit = parse_memory_limit("50%");
  EXPECT_EQ(limit.bytes, 0U);
  EXPECT_EQ(limit.share, 0.5);
}

TEST(MemoryLimit, IsNothingElse) {
  for (const char* const text :
       {"", "G", "%", "0", "-1G", "0%", "101%", "nan", "inf", "1e30", "2 G",
        "2GB", "2T", "G2", "1G%", "0x10"}) {
    EXPECT_THROW(parse_memory_limit(text), compiler::RequestError) << text;
  }
}

TEST(MemoryLimit, IsShownInItsUnit) {
  EXPECT_EQ(memory_size_text(12), "12 bytes");
  EXPECT_EQ(memory_size_text(800U << 10), "800 KiB");
  EXPECT_EQ(memory_size_text(500U << 20), "500 MiB");
  EXPECT_EQ(memory_size_text(std::uint64_t{20} << 30), "20.0 GiB");
}

TEST(Limits, OptionsTakeNoNonsense) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--max-memory", "much"},
        {"--max-memory", "0"},
        {"--max-time", "0"},
        {"--max-time", "-1"},
        {"--max-time", "nan"},
        {"--max-time", "1 min"}}) {
    const auto result = run(folder, {"a.scad", words[0], words[1]});
    EXPECT_EQ(result.status, 2) << words[1];
    EXPECT_TRUE(has(result.errors, words[0])) << result.errors;
  }
}

// --- The machine -------------------------------------------------------------

void make_group(const TemporaryFolder& folder, const std::string& path,
                const std::string& file, const std::string& text) {
  std::filesystem::create_directories(folder.path() + "/sys/fs/cgroup" + path);
  folder.write("sys/fs/cgroup" + path + "/" + file, text);
}

void make_groups(const TemporaryFolder& folder, const std::string& text) {
  std::filesystem::create_directories(folder.path() + "/proc/self");
  folder.write("proc/self/cgroup", text);
}

TEST(ControlGroups, LimitOfVersion2IsTheLeastOnTheWayUp) {
  const TemporaryFolder folder;
  make_groups(folder, "0::/jobs/17\n");
  make_group(folder, "/jobs", "memory.max", "1000000\n");
  make_group(folder, "/jobs/17", "memory.max", "max\n");
  EXPECT_EQ(control_group_memory(folder.path()), 1000000U);
  make_group(folder, "/jobs/17", "memory.max", "500000\n");
  EXPECT_EQ(control_group_memory(folder.path()), 500000U);
}

TEST(ControlGroups, LimitOfVersion1IsFoundBesideOthers) {
  const TemporaryFolder folder;
  make_groups(folder, "5:devices:/\n4:memory:/jobs/17\n0::/\n");
  make_group(folder, "/memory/jobs/17", "memory.limit_in_bytes", "700000\n");
  EXPECT_EQ(control_group_memory(folder.path()), 700000U);
}

// What is mounted in a container begins with its own group.
TEST(ControlGroups, LimitOfAContainerIsAtTheRoot) {
  const TemporaryFolder folder;
  make_groups(folder, "4:memory:/docker/0123\n0::/docker/0123\n");
  make_group(folder, "", "memory.max", "800000\n");
  EXPECT_EQ(control_group_memory(folder.path()), 800000U);
}

TEST(ControlGroups, MayHaveNoLimit) {
  const TemporaryFolder folder;
  EXPECT_EQ(control_group_memory(folder.path()), 0U);
  make_groups(folder, "nonsense\n0::/\n");
  make_group(folder, "", "memory.max", "max\n");
  EXPECT_EQ(control_group_memory(folder.path()), 0U);
}

TEST(MachineMemory, IsKnown) {
  EXPECT_GT(machine_memory(), 1U << 20);
  EXPECT_GT(resident_memory(), 1U << 20);
  EXPECT_GT(writable_memory(), 1U << 16);
}

// --- Time --------------------------------------------------------------------

TEST(MaxTime, EndsARunThatHasNoEnd) {
  const TemporaryFolder folder;
  folder.write("a.scad", kEndless);
  const auto result = run(folder, {"a.scad", "--max-time", "0.3"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.errors,
            "error: out of time: this takes more than 0.3 s; --max-time gives "
            "it more\n");
  expect_no_output(folder);
}

TEST(MaxTime, HoldsForEveryCommand) {
  const TemporaryFolder folder;
  folder.write("a.scad", kEndless);
  folder.write("b.scad", "cube(1);");
  const std::vector<std::vector<std::string>> commands = {
      {"inspect", "a.scad"},
      {"view", "a.scad", "-o", "a.png"},
      {"compare", "b.scad", "a.scad"},
      {"a.scad", "--watch"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--max-time", "0.2"});
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, 1) << words[0];
    EXPECT_TRUE(has(result.errors, "--max-time gives it more")) << words[0];
    expect_no_output(folder);
  }
}

TEST(MaxTime, EndsABatchAndNamesThePiece) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               std::string("n = 0; if (n > 0) echo(f(n)); cube(1);") +
                   "function f(n) = n == 0 ? 0 : let(s = f(n - 1)) s + "
                   "f(n - 1);");
  folder.write("t.csv", "name,n\ngood,0\nbad,60\n");
  const auto result =
      run(folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{name}.slc",
                   "--max-time", "0.4", "--threads", "1"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors,
                  "t.csv:3: bad: error: out of time: this takes more than 0.4 "
                  "s; --max-time gives it more"))
      << result.errors;
  // What was done before stays.
  EXPECT_TRUE(std::filesystem::exists(folder.file("good.slc")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("bad.slc")));
}

// More echoes than a pipe holds.
constexpr const char* kTalkative =
    "for (i = [1:300], j = [1:100]) echo(i, j); cube(1);";

// The status of a run whose standard error is a pipe that nobody reads; as
// after SIGKILL where it needs 20 s.
//
// words  of the program, in the language of the shell
int status_unread(const TemporaryFolder& folder, const std::string& words) {
  return support::run_process(
             {"bash", "-c",
              "mkfifo p; exec 3<>p; rm p; exec timeout -s KILL 20 " +
                  std::string(LAMINA_PROGRAM) + " " + words + " 2>&3"},
             folder.path())
      .status;
}

TEST(MaxTime, EndsThoughNobodyReadsErrors) {
  const TemporaryFolder folder;
  folder.write("a.scad", kTalkative);
  EXPECT_EQ(status_unread(folder, "a.scad --max-time 0.5"), 1);
  expect_no_output(folder);
}

TEST(MaxMemory, EndsThoughNobodyReadsErrors) {
  const TemporaryFolder folder;
  folder.write("a.scad", kTalkative);
  EXPECT_EQ(status_unread(folder, "a.scad --max-memory 5M"), 1);
  expect_no_output(folder);
}

TEST(MaxTime, EndsABatchWhoseMessagesNobodyReads) {
  const TemporaryFolder folder;
  folder.write("a.scad", kTalkative);
  folder.write("t.csv", "name\na\nb\nc\n");
  for (const char* const threads : {"1", "2"}) {
    EXPECT_EQ(status_unread(folder,
                            "batch a.scad --table t.csv -o {name}.slc "
                            "--max-time 0.5 --threads " +
                                std::string(threads)),
              1)
        << threads;
  }
}

// What is left to say when all pieces are made.
TEST(MaxTime, EndsABatchWhoseTableNobodyReads) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  std::string table = "name\n";
  for (int i = 0; i < 400; ++i) {
    table += fmt::format("{:x>200}\n", i);
  }
  folder.write("t.csv", table);
  EXPECT_EQ(status_unread(folder,
                          "batch a.scad --table t.csv -o {name}.slc "
                          "--layer 0.5 --max-time 1"),
            1);
}

// --- Memory ------------------------------------------------------------------

TEST(MaxMemory, EndsARun) {
  const TemporaryFolder folder;
  folder.write("a.scad", kHungry);
  const auto result = run(folder, {"a.scad", "--max-memory", "100M"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "error: out of memory")) << result.errors;
  EXPECT_TRUE(has(result.errors, "--max-memory")) << result.errors;
  // What one look may miss, and no more.
  EXPECT_LT(result.peak_memory_kib, 1024 * 1024);
  expect_no_output(folder);
}

// Where scratch files have no folder they are held in memory.
TEST(MaxMemory, CountsWhatIsHeldForStandardOutput) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cylinder(r = 10, h = 100, $fn = 2000);");
  const std::string command = std::string("TMPDIR=/nowhere exec ") +
                              LAMINA_PROGRAM +
                              " a.scad -o - --export-format svg --tolerance 0 "
                              "--layer 0.05 --max-memory ";
  const auto result =
      support::run_process({"bash", "-c", command + "60M"}, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "error: out of memory")) << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(support::run_process({"bash", "-c", command + "1G > /dev/null"},
                                 folder.path())
                .status,
            0);
}

// Stacks of threads are address space: they are none of the limit, be they made
// before the first look at the memory or, where it takes long to read a
// design, after it.
TEST(MaxMemory, LeavesStacksToManyThreads) {
  const TemporaryFolder folder;
  // As deep as a whole stack allows.
  std::string design =
      "n = 0; cube(1);\n"
      "function deep(n) = n == 0 ? 0 : 1 + deep(n - 1);\n"
      "assert(n > 2 || deep(150000) == 150000);\n";
  std::string table = "n\n";
  for (int i = 1; i <= 16; ++i) table += fmt::format("{}\n", i);
  folder.write("t.csv", table);
  for (const int functions : {0, 20000}) {
    for (int i = 0; i < functions; ++i) {
      design +=
          fmt::format("function f{0}(x) = x * {0} + sin(x) + [x][0];\n", i);
    }
    folder.write("a.scad", design);
    const auto result =
        run(folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{n}.slc",
                     "--threads", "16", "--max-memory", "700M"});
    EXPECT_EQ(result.status, 0) << functions << "\n" << result.errors;
  }
}

TEST(MaxMemory, OfAnyShareIsALimit) {
  const TemporaryFolder folder;
  folder.write("a.scad", kEndless);
  const auto result = run(folder, {"a.scad", "--max-memory", "0.0000000000001%",
                                   "--max-time", "60"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "out of memory")) << result.errors;
}

// What the system grants is never exceeded for them.
TEST(MaxMemory, OfTheSystemStaysForManyThreads) {
  const TemporaryFolder folder;
  folder.write("a.scad", "n = 0; cube(1);");
  folder.write("t.csv", "n\n1\n2\n3\n4\n");
  const auto result = support::run_process(
      {"bash", "-c",
       std::string("ulimit -d 3000000; exec ") + LAMINA_PROGRAM +
           " batch a.scad --table t.csv -o {n}.slc --threads 4"},
      folder.path());
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST(MaxMemory, OfTheSystemIsNamed) {
  const TemporaryFolder folder;
  folder.write("a.scad", kHungry);
  const auto result = support::run_process(
      {"bash", "-c",
       std::string("ulimit -v 1000000; exec ") + LAMINA_PROGRAM + " a.scad"},
      folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "error: out of memory: the system grants"))
      << result.errors;
  EXPECT_TRUE(has(result.errors, "ulimit -v")) << result.errors;
  expect_no_output(folder);
}

// Below 46 MiB the stacks leave some kB, which may be too few for the buffers
// of the lexer.
TEST(MaxMemory, OfTheSystemMayDenyTheLexerItsBuffers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (int kib = 44000; kib <= 48000; kib += 12) {
    const auto result = support::run_process(
        {"bash", "-c",
         fmt::format("ulimit -v {}; exec {} a.scad -o a.ast", kib,
                     LAMINA_PROGRAM)},
        folder.path());
    EXPECT_TRUE(result.status == 0 ||
                (result.status == 1 && has(result.errors, "(ulimit -v)")))
        << kib << ": " << result.status << ' ' << result.errors;
  }
}

// A stack takes what it can have, which may leave a second thread without one.
TEST(MaxMemory, OfTheSystemMayDenyAThreadItsStack) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const int kib : {1000, 36000, 40000, 72000, 140000}) {
    const auto result = support::run_process(
        {"bash", "-c",
         fmt::format("ulimit -d {}; exec {} a.scad -o a.slc --threads 2", kib,
                     LAMINA_PROGRAM)},
        folder.path());
    EXPECT_LE(result.status, 1);
    EXPECT_EQ(result.status == 1,
              has(result.errors, "(ulimit -") && has(result.errors, "-d"))
        << result.errors;
    EXPECT_FALSE(has(result.errors, "internal error")) << result.errors;
  }
}

// A sum of two combs has 160,000 pairs of convex pieces, and hardly as many
// corners as the combs.
TEST(Memory, OfASumInThePlaneFollowsItsCorners) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "c = [for (i = [0 : 399]) each [[i, 0], [i + 0.5, 10]], "
               "[400, -1], [0, -1]]; linear_extrude(1) "
               "minkowski() { polygon(c); polygon(c); }");
  const auto result = run(folder, {"a.scad", "--layer", "1"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_LT(result.peak_memory_kib, 300 * 1000);
}

// --- What a design may ask for -----------------------------------------------

// What is refused before it is made: within a second, in little memory.
void expect_refused(const std::string& design, const std::string& error,
                    const std::vector<std::string>& options = {}) {
  const TemporaryFolder folder;
  folder.write("a.scad", design);
  std::vector<std::string> words = {"a.scad"};
  words.insert(words.end(), options.begin(), options.end());
  const auto result = run(folder, words);
  EXPECT_EQ(result.status, 1) << design;
  EXPECT_TRUE(has(result.errors, error)) << result.errors;
  EXPECT_LT(result.peak_memory_kib, 300 * 1000) << design;
  expect_no_output(folder);
}

constexpr const char* kTooManyOfACircle =
    " of a circle, at most 1000000 can be ($fn; $fa and $fs; "
    "--chordal-error)\n";

TEST(Fragments, AreAMillionAtMost) {
  const struct {
    const char* design;
    const char* place;
    const char* count;
  } cases[] = {
      {"cylinder(r = 1, h = 1, $fn = 1000001);", "1:1", "1000001"},
      {"translate([1, 0])\n  circle(1, $fn = 1e300);", "2:3", "1e+300"},
      {"rotate_extrude($fn = 1e7) translate([2, 0]) square(1);", "1:1",
       "1e+07"},
      {"linear_extrude(1) offset(1, $fn = 1e8) square(1);", "1:19", "1e+08"},
      {"linear_extrude(1) offset(10, $fs = 1e-9, $fa = 1e-9) square(1);",
       "1:19", "6.283185e+10"},
      {"linear_extrude(1) text(\"o\", $fn = 1e8);", "1:19", "1e+08"},
  };
  for (const auto& one : cases) {
    expect_refused(one.design, std::string("a.scad:") + one.place +
                                   ": error: Too many fragments: " + one.count +
                                   kTooManyOfACircle);
  }
}

TEST(Fragments, OfAChordalErrorAreAsMany) {
  expect_refused("cylinder(r = 1e8, h = 1);",
                 "a.scad:1:1: error: Too many fragments: 2.22",
                 {"--chordal-error", "1e-6"});
  // Its first guess is not too many.
  expect_refused("sphere(1.11e5);",
                 "a.scad:1:1: error: Too many fragments: 1000001 of a circle",
                 {"--chordal-error", "1e-6"});
}

TEST(Fragments, OfAMillionAreMade) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cylinder(r = 1, h = 0.1, $fn = 1e6);");
  EXPECT_EQ(run(folder, {"a.scad", "-q"}).status, 0);
}

TEST(Triangles, OfAPartAreAHundredMillionAtMost) {
  for (const char* const design :
       {"sphere(1, $fn = 20000);", "sphere(1e6, $fs = 1e-3, $fa = 0);",
        "linear_extrude(1, twist = 360, slices = 1e8) square(1);",
        "linear_extrude(1, twist = 1e9, slices = 2147483647) square(1);",
        "linear_extrude(1, scale = [1, 2], $fn = 1e8) square(1);",
        "rotate_extrude($fn = 1e6) translate([2, 0]) circle(1, $fn = 1e3);",
        "rotate_extrude(angle = 300, $fn = 1e6) translate([2, 0]) "
        "circle(1, $fn = 1e3);",
        "minkowski() { difference() { cylinder(r = 5, h = 1, $fn = 20000);"
        " cube(9); } rotate([90, 0, 0]) cylinder(r = 1, h = 1, $fn = 20000);"
        " }"}) {
    expect_refused(design, "a.scad:1:1: error: Too many triangles: ");
  }
}

TEST(Triangles, OfAPartNameItsCallers) {
  expect_refused(
      "module ball() sphere(1, $fn = 20000);\nball();",
      "a.scad:1:15: error: Too many triangles: 4e+08 of one part, at most "
      "1e+08 can be\n"
      "    1 | module ball() sphere(1, $fn = 20000);\n"
      "      |               ^~~~~~~~~~~~~~~~~~~~~~\n"
      "a.scad:2:1: note: called by 'ball'");
}

// Made as long as the longest, the rows of this file of 120 kB would take 7 GB.
TEST(Heights, OfASurfaceAreEightMillionAtMost) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 30000; ++i) text += "0 ";
  for (int i = 0; i < 30000; ++i) text += "\n0";
  folder.write("a.dat", text);
  expect_refused("cube(1);\nsurface(\"" + folder.file("a.dat") + "\");",
                 "a.scad:2:1: error: Too many heights: 30000 x 280 of a "
                 "surface, at most 8388608 can be");
}

TEST(Layers, AreTenMillionAtMost) {
  const std::string error =
      "error: Too many layers: 1e+09 of 1e-09 mm, at most 1e+07 can be; "
      "--layer makes them thicker\n";
  expect_refused("cube(1);", error, {"--layer", "1e-9"});
  expect_refused("cube(1);", error, {"--layer", "1e-9", "--adaptive", "0.01"});
}

TEST(Leaves, AreCountedAsTheyAreMade) {
  const char* const design =
      "for (i = [0:9], j = [0:9])\n  translate([i, j]) cube(1);";
  expect_refused(design,
                 "a.scad:2:21: error: Too many leaves: more than the 99 that "
                 "--max-leaves allows",
                 {"--max-leaves", "99"});
  const TemporaryFolder folder;
  folder.write("a.scad", design);
  EXPECT_EQ(run(folder, {"a.scad", "-q", "--max-leaves", "100"}).status, 0);
}

TEST(Depth, IsThatOfCalls) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "function f(n) = n == 1 ? 1 : 1 + f(n - 1);\n"
               "module m(n) if (n > 1) m(n - 1); else cube(f(40));\n"
               "m(20);");
  // Statements such as if() are calls, too.
  EXPECT_EQ(run(folder, {"a.scad", "-q", "--max-depth", "81"}).status, 0);
  const auto result = run(folder, {"a.scad", "--max-depth", "50"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors,
                  "error: Recursion detected calling function "
                  "'f'"))
      << result.errors;
  EXPECT_TRUE(
      has(result.errors, "note: 50 calls are nested, the limit of --max-depth"))
      << result.errors;
}

}  // namespace
}  // namespace lamina::cli
