// Shares of a table, ledgers, and going on where a batch was cut short.

#include "cli/pieces/ledger.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file/append_file.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

using support::read_file;
using support::TemporaryFolder;
using Words = std::vector<std::string>;

using support::has;

// Orders of cubes, of which those named in `bad` have no number for a size.
class Ledgers : public testing::Test {
 protected:
  void write_orders(int count, const std::set<int>& bad = {}) {
    folder_.write("a.scad", "include <part.scad>\nsize = 1; part(size);");
    folder_.write("part.scad", "module part(s) { cube(s); }");
    std::string table = "name,size\n";
    for (int i = 1; i <= count; ++i) {
      table += bad.contains(i) ? fmt::format("p{},x\n", i)
                               : fmt::format("p{},{}\n", i, i);
    }
    folder_.write("t.csv", table);
  }

  support::ProcessResult batch(const Words& more = {}) const {
    Words words = {"batch", "a.scad", "--table", "t.csv"};
    if (std::find(more.begin(), more.end(), "-o") == more.end()) {
      words.insert(words.end(), {"-o", "out/{name}.csg"});
    }
    words.insert(words.end(), more.begin(), more.end());
    return run(folder_, words);
  }

  // Resumes, and returns how many pieces stood.
  int count_standing(const Words& more = {}) const {
    Words words = {"--ledger", "l", "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    const std::string text = batch(words).errors;
    const std::size_t mark = text.find(" of them before");
    if (mark == std::string::npos) return 0;
    return std::stoi(text.substr(text.rfind('(', mark) + 1));
  }

  // All outputs and their bytes.
  std::map<std::string, std::string> outputs(const std::string& in) const {
    std::map<std::string, std::string> all;
    if (!fs::exists(folder_.file(in))) return all;
    for (const auto& entry :
         fs::recursive_directory_iterator(folder_.file(in))) {
      if (entry.is_directory()) continue;
      all[fs::relative(entry.path(), folder_.file(in))] =
          read_file(entry.path());
    }
    return all;
  }

  nlohmann::json collect(const Words& ledgers, int status) const {
    Words words = {"--report", "sum.json", "--collect"};
    words.insert(words.end(), ledgers.begin(), ledgers.end());
    const auto result = batch(words);
    EXPECT_EQ(result.status, status) << result.errors;
    return nlohmann::json::parse(read_file(folder_.file("sum.json")));
  }

  const TemporaryFolder folder_;
};

// --- Shares -----------------------------------------------------------------

TEST_F(Ledgers, SharesMakeEachPieceOnceAndWithTheSameBytes) {
  write_orders(20);
  EXPECT_EQ(batch().status, 0);
  std::map<std::string, std::string> united;
  for (int k = 1; k <= 3; ++k) {
    const std::string share = fmt::format("{}/3", k);
    const std::string out = fmt::format("share{}", k);
    EXPECT_EQ(batch({"--shard", share, "-o", out + "/{name}.csg"}).status, 0);
    for (const auto& [name, bytes] : outputs(out)) {
      EXPECT_TRUE(united.emplace(name, bytes).second) << name;
    }
  }
  EXPECT_EQ(united, outputs("out"));
}

TEST_F(Ledgers, ARowKeepsItsShareWhenOthersAreAppended) {
  write_orders(10);
  batch({"--shard", "2/4"});
  const auto before = outputs("out");
  write_orders(30);
  batch({"--shard", "2/4"});
  const auto after = outputs("out");
  EXPECT_TRUE(
      std::includes(after.begin(), after.end(), before.begin(), before.end()));
}

TEST_F(Ledgers, AShareBeyondTheTableIsDone) {
  write_orders(2);
  const auto result = batch({"--shard", "3/3"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors, "0 of 0 pieces done, 0 failed"));
}

TEST_F(Ledgers, EveryShareRefusesATableWithEqualOutputs) {
  folder_.write("a.scad", "size = 1; cube(size);");
  std::string table = "name,size\n";
  for (int i = 1; i <= 50'000; ++i) {
    table += fmt::format("p{},1\n", i == 49'999 ? 7 : i);
  }
  folder_.write("t.csv", table);
  for (const char* const share : {"1/50000", "7/50000", "49999/50000"}) {
    const auto result = batch({"--shard", share});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(has(result.errors,
                    "t.csv:8: p7: and t.csv:50000: p7: would both write "
                    "'out/p7.csg'"))
        << result.errors;
  }
  EXPECT_FALSE(fs::exists(folder_.file("out")));
}

TEST_F(Ledgers, FoldersHoldABoundedNumberOfOutputs) {
  write_orders(25);
  EXPECT_EQ(batch({"-o", "out/{row:/10}/{name}.csg"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_.file("out/0/p9.csg")));
  EXPECT_TRUE(fs::exists(folder_.file("out/1/p10.csg")));
  EXPECT_TRUE(fs::exists(folder_.file("out/2/p25.csg")));
  for (const char* const pattern :
       {"{row:/0}.csg", "{row:/}.csg", "{row:/x}.csg"}) {
    EXPECT_EQ(batch({"-o", pattern}).status, 2) << pattern;
  }
  const auto result = batch({"-o", "{name:/10}.csg"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(
      has(result.errors, "'{name:/10}' divides whole numbers, not 'p1'"))
      << result.errors;
}

TEST_F(Ledgers, RefuseWhatDoesNotGoTogether) {
  write_orders(2);
  for (const Words& words :
       std::vector<Words>{{"--resume"},
                          {"--shard", "0/3"},
                          {"--shard", "4/3"},
                          {"--shard", "3"},
                          {"--shard", "1/3x"},
                          {"--collect"},
                          {"--ledger", "l", "--collect", "l"}}) {
    EXPECT_EQ(batch(words).status, 2) << words.front();
  }
  EXPECT_EQ(batch({"--ledger", "t.csv"}).status, 1);
  EXPECT_EQ(batch({"--ledger", "out/p1.csg"}).status, 1);
  EXPECT_EQ(
      batch({"-o", "{name}.slc", "--ledger", "l", "--report", "l"}).status, 1);
  EXPECT_EQ(folder_.entry_count(), 3U);
}

// --- Many pieces ------------------------------------------------------------

TEST_F(Ledgers, ThousandsOfPiecesHaveNoTable) {
  write_orders(1500, {700, 1400});
  const auto result = batch({"-o", "out/{row:/1000}/{name}.csg"});
  EXPECT_EQ(result.status, 1);
  const std::string& text = result.errors;
  EXPECT_TRUE(has(text, "t.csv:701: p700: error: size: a number was expected"))
      << text;
  EXPECT_TRUE(has(text, "t.csv:1401: p1400: error: size: a number"));
  EXPECT_TRUE(has(text, "\n1498 of 1500 pieces done, 2 failed, in "));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

// --- Going on ---------------------------------------------------------------

TEST_F(Ledgers, WhatStandsIsNotMadeAgain) {
  write_orders(4);
  EXPECT_EQ(count_standing(), 0);
  EXPECT_EQ(count_standing(), 4);
  EXPECT_EQ(count_standing({"--threads", "2", "--max-time", "99"}), 4);
  // Without the word all are made.
  EXPECT_FALSE(has(batch({"--ledger", "l"}).errors, "before"));
}

TEST_F(Ledgers, AnOutputThatIsMissingOrChangedIsMadeAgain) {
  write_orders(4);
  count_standing();
  const auto before = outputs("out");
  fs::remove(folder_.file("out/p2.csg"));
  std::string other = before.at("p3.csg");
  std::replace(other.begin(), other.end(), '3', '4');
  folder_.write("out/p3.csg", other);
  EXPECT_EQ(count_standing(), 2);
  EXPECT_EQ(outputs("out"), before);
}

TEST_F(Ledgers, WhatWasReadCountsByItsBytes) {
  write_orders(3);
  folder_.write("a.scad",
                "include <part.scad>\nsize = 1; part(size);\n"
                "if (size == 2) linear_extrude(1) import(\"plan.svg\");");
  const std::string plan =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" height=\"9mm\" "
      "viewBox=\"0 0 9 9\"><rect width=\"5\" height=\"5\"/></svg>";
  folder_.write("plan.svg", plan);
  const Words slc = {"-o", "out/{name}.slc"};
  count_standing(slc);
  EXPECT_EQ(count_standing(slc), 3);
  folder_.write("plan.svg", plan + "\n");  // only the second piece reads it
  EXPECT_EQ(count_standing(slc), 2);
  EXPECT_EQ(count_standing(slc), 3);
  folder_.write("part.scad", "module part(s) { cube(2 * s); }");
  EXPECT_EQ(count_standing(slc), 0);
  EXPECT_EQ(count_standing(slc), 3);
}

TEST_F(Ledgers, WhatWasAskedCounts) {
  write_orders(3);
  count_standing();
  EXPECT_EQ(count_standing({"--seed", "7"}), 0);
  EXPECT_EQ(count_standing({"--seed", "7"}), 3);
  EXPECT_EQ(count_standing({"-o", "new/{name}.csg"}), 0);
  folder_.write("t.csv", "name,size\nnew,9\np1,1\np2,7\np3,3\n");
  EXPECT_EQ(count_standing(), 2);
}

TEST_F(Ledgers, ASetCountsByItsValues) {
  folder_.write("a.scad", "size = 1; cube(size);");
  for (const char* size : {"6", "9"}) {
    folder_.write("t.json",
                  fmt::format(R"({{"parameterSets": {{"s": {{"size": "{}"}},)"
                              R"( "other": {{"size": "3"}}}}}})",
                              size));
    const auto result =
        run(folder_, {"batch", "a.scad", "--table", "t.json", "-o",
                      "out/{name}.csg", "--ledger", "l", "--resume"});
    EXPECT_TRUE(has(outputs("out")["s.csg"], size));
    EXPECT_EQ(has(result.errors, "(1 of them before)"),
              std::string(size) == "9")
        << result.errors;
  }
}

TEST_F(Ledgers, KnowNamesThatAreNoUtf8) {
  write_orders(3);
  folder_.write("caf\xe9.scad", "module part(s) { cube(s); }");
  folder_.write("a.scad", "include <caf\xe9.scad>\nsize = 1; part(size);");
  const Words out = {"-o", "caf\xe9/{name}.csg"};
  count_standing(out);
  EXPECT_EQ(count_standing(out), 3);
  EXPECT_EQ(batch({"-o", out[1], "--collect", "l"}).status, 0);
  // Another folder of the same letters, once what is no UTF-8 is replaced.
  EXPECT_EQ(count_standing({"-o", "caf\xe8/{name}.csg"}), 0);
  folder_.write("caf\xe9.scad", "module part(s) { sphere(s); }");
  EXPECT_EQ(count_standing(out), 0);
}

TEST_F(Ledgers, AFileIsReadAgainThoughItsTimeWasSetBack) {
  const std::string path = folder_.write("a", "1");
  FileDigests digests(kAllFiles);
  const std::string before = digests.digest_of(path);
  const auto time = fs::last_write_time(path);
  // Longer than the system's clock of files stands still.
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  folder_.write("a", "2");
  fs::last_write_time(path, time);
  EXPECT_NE(digests.digest_of(path), before);
}

TEST_F(Ledgers, AFolderOfImagesStandsWithAllOfThem) {
  write_orders(2);
  const Words images = {"-o", "out/{name}.png", "--layer", "0.5"};
  EXPECT_EQ(count_standing(images), 0);
  EXPECT_EQ(count_standing(images), 2);
  const auto made = outputs("out");
  fs::remove(folder_.file("out/p1.png/00000.png"));
  folder_.write("out/p2.png/00000.png", "junk");
  EXPECT_EQ(count_standing(images), 0);
  EXPECT_EQ(outputs("out"), made);
}

TEST_F(Ledgers, AFileThatIsMovedHereMeanwhileIsNotTakenForWhatWasRead) {
  write_orders(2);
  fs::last_write_time(folder_.file("part.scad"),
                      fs::file_time_type::clock::now() + std::chrono::hours(1));
  count_standing();
  EXPECT_EQ(count_standing(), 2);
}

TEST_F(Ledgers, AnOutputOfTheRunMayBeWhatAnotherLineRead) {
  write_orders(2);
  folder_.write("b.scad", "include <out/p1.csg>");
  const Words derived = {"batch",    "b.scad", "--table", "t.csv",
                         "--skip",   "size",   "-o",      "out/b-{name}.csg",
                         "--ledger", "l",      "--resume"};
  EXPECT_EQ(batch({"--ledger", "l", "--resume"}).status, 0);
  EXPECT_EQ(run(folder_, derived).status, 0);
  write_orders(3);
  const auto again = batch({"--ledger", "l", "--resume"});
  EXPECT_EQ(again.status, 0) << again.errors;
}

TEST_F(Ledgers, WhatFailedIsTriedAgain) {
  write_orders(3, {2});
  EXPECT_EQ(count_standing(), 0);
  EXPECT_EQ(count_standing(), 2);
  write_orders(3);
  EXPECT_EQ(count_standing(), 2);
  EXPECT_EQ(count_standing(), 3);
}

TEST_F(Ledgers, ALineForEachPieceTellsWhatCameOfIt) {
  write_orders(2, {2});
  EXPECT_EQ(batch({"--ledger", "new/l"}).status, 1);
  std::istringstream lines(read_file(folder_.file("new/l")));
  std::map<std::string, nlohmann::json> by_name;
  for (std::string line; std::getline(lines, line);) {
    const auto entry = nlohmann::json::parse(line);
    by_name[entry.value("name", "")] = entry;
  }
  const nlohmann::json& done = by_name.at("p1");
  EXPECT_EQ(done["status"], "done");
  EXPECT_EQ(done["row"], 1);
  EXPECT_EQ(done["line"], 2);
  EXPECT_EQ(done["output"], "out/p1.csg");
  EXPECT_EQ(done["bytes"], read_file(folder_.file("out/p1.csg")).size());
  EXPECT_GT(done["seconds"], 0);
  EXPECT_GT(done["memory"], 1'000'000);
  const nlohmann::json& failed = by_name.at("p2");
  EXPECT_EQ(failed["status"], "failed");
  EXPECT_TRUE(has(failed["messages"][0], "t.csv:3: p2: error: size: a number"));
}

// --- Collecting -------------------------------------------------------------

TEST_F(Ledgers, TogetherTellWhatIsMissingFailedAndTwice) {
  write_orders(9, {5});
  batch({"--shard", "1/3", "--ledger", "1"});
  batch({"--shard", "2/3", "--ledger", "2"});
  batch({"--shard", "1/3", "--ledger", "again"});
  auto sum = collect({"1", "2", "3", "again"}, 1);
  EXPECT_EQ(sum["count"], 9);
  EXPECT_EQ(sum["done"], 5);
  EXPECT_EQ(sum["failed"], 1);
  EXPECT_EQ(sum["missing"], 3);
  EXPECT_EQ(sum["twice"], 3);
  std::map<int, std::string> told;
  for (const auto& piece : sum["pieces"]) told[piece["row"]] = piece["status"];
  EXPECT_EQ(told, (std::map<int, std::string>{{1, "twice"},
                                              {3, "missing"},
                                              {4, "twice"},
                                              {5, "failed"},
                                              {6, "missing"},
                                              {7, "twice"},
                                              {9, "missing"}}));
  const auto result = batch({"--collect", "1", "2"});
  EXPECT_TRUE(has(result.errors, "t.csv:4: p3: missing\n")) << result.errors;
  EXPECT_TRUE(has(result.errors, "t.csv:6: p5: failed: size: a number"));

  write_orders(9);
  batch({"--shard", "3/3", "--ledger", "3"});
  batch({"--shard", "2/3", "--ledger", "2", "--resume"});
  sum = collect({"1", "2", "3"}, 0);
  EXPECT_EQ(sum["done"], 9);
  EXPECT_TRUE(sum["pieces"].empty());
  fs::remove(folder_.file("out/p4.csg"));
  EXPECT_EQ(collect({"1", "2", "3"}, 1)["missing"], 1);
}

// --- Torn ledgers -----------------------------------------------------------

TEST_F(Ledgers, TogetherSeeOutputsThatHoldSomethingElse) {
  write_orders(2);
  batch({"--ledger", "l"});
  std::string bytes = read_file(folder_.file("out/p2.csg"));
  bytes[bytes.find('2')] = '7';
  folder_.write("out/p2.csg", bytes);
  EXPECT_EQ(collect({"l"}, 1).at("missing"), 1);
}

TEST_F(Ledgers, TogetherReadNoOutputThatIsLongerThanNoted) {
  write_orders(2);
  batch({"--ledger", "l"});
  fs::resize_file(folder_.file("out/p2.csg"), std::uintmax_t{1} << 36);
  EXPECT_EQ(collect({"l"}, 1).at("missing"), 1);
  EXPECT_EQ(count_standing(), 1);
  EXPECT_EQ(collect({"l"}, 0).at("done"), 2);
}

TEST_F(Ledgers, TogetherTellTheFaultAndNotWhatWasSaidBefore) {
  write_orders(2);
  folder_.write("a.scad",
                "size = 1; for (i = [0 : 500]) echo(str(\"all is well\", i));"
                "cube(size); assert(size < 2, \"too big\");");
  batch({"--ledger", "loud"});
  batch({"--ledger", "quiet", "-q"});
  for (const char* ledger : {"loud", "quiet"}) {
    const auto sum = collect({ledger}, 1);
    EXPECT_TRUE(has(sum.at("pieces")[0].at("error"), "too big")) << sum;
    const auto result = batch({"--collect", ledger});
    EXPECT_TRUE(has(result.errors, "t.csv:3: p2: failed: Assertion"))
        << result.errors;
    EXPECT_FALSE(has(result.errors, "well")) << result.errors;
  }
}

TEST_F(Ledgers, LinesOfAnEarlierDesignHideNoneOfTodays) {
  write_orders(2);
  batch({"--ledger", "z"});
  const std::string design = read_file(folder_.file("a.scad"));
  folder_.write("a.scad", "size = 1; assert(size > 9);");
  batch({"--ledger", "b", "-o", "other/{name}.csg"});
  folder_.write("a.scad", "size = 1; sphere(size);");
  batch({"--ledger", "a"});
  const auto sum = collect({"a", "b", "z"}, 0);
  EXPECT_EQ(sum.at("done"), 2);
  EXPECT_EQ(sum.at("twice"), 0);
}

TEST_F(Ledgers, TornAtAnyByteKeepTheirWholeLines) {
  write_orders(3);
  batch({"--ledger", "l"});
  const std::string whole = read_file(folder_.file("l"));
  std::set<std::string> asked;  // of all pieces
  std::istringstream lines(whole);
  for (std::string line; std::getline(lines, line);) {
    const auto entry = nlohmann::json::parse(line);
    if (entry.contains("key")) {
      asked.insert(entry["key"].get<std::string>().substr(0, 32));
    }
  }
  fs::current_path(folder_.path());  // where the files of the ledger lie
  const auto count_done = [&] {
    LedgerIndex index(kAllFiles);
    index.read("torn", kAllFiles.open("torn"));
    index.close();
    return std::count_if(
        asked.begin(), asked.end(), [&](const std::string& key) {
          return index.find(key).state == LedgerIndex::State::kDone;
        });
  };
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    folder_.write("torn", whole.substr(0, size));
    // The last line counts even without its end.
    const auto ends = std::count(
        whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size), '\n');
    const bool is_before_end = size < whole.size() && whole[size] == '\n';
    const auto wanted =
        std::max<std::ptrdiff_t>(0, ends + (is_before_end ? 1 : 0) - 1);
    ASSERT_EQ(count_done(), wanted) << size;
    // What is appended begins on a line of its own.
    AppendFile file = AppendFile::open("torn", kAllFiles);
    std::istringstream again(whole);
    for (std::string line; std::getline(again, line);) file.append(line);
    ASSERT_EQ(count_done(), 3) << size;
  }
}

TEST_F(Ledgers, TornOnesAreCompletedByAResumedRun) {
  write_orders(3, {2});
  batch({"--ledger", "l"});
  const std::string whole = read_file(folder_.file("l"));
  const auto bytes = outputs("out");
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    folder_.write("l", whole.substr(0, size));
    EXPECT_LE(count_standing(), 2);
    EXPECT_EQ(count_standing(), 2) << size;
    const auto sum = collect({"l"}, 1);
    EXPECT_EQ(sum["done"], 2) << size;
    EXPECT_EQ(sum["failed"], 1) << size;
    EXPECT_EQ(outputs("out"), bytes);
  }
}

}  // namespace
}  // namespace lamina::cli
