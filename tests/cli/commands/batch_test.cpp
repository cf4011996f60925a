// Several pieces in one run: `lamina batch`, and several designs.

#include <filesystem>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include "base/file/csv.h"
#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

using support::has;
using support::read_file;
using support::TemporaryFolder;

std::size_t count_lines(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    count += line.starts_with(begin) ? 1 : 0;
  }
  return count;
}

std::size_t count_files(const std::string& path) {
  const auto begin = fs::directory_iterator(path);
  return static_cast<std::size_t>(
      std::distance(begin, fs::directory_iterator()));
}

// What the rows of a table make a design echo.
class Echoes {
 public:
  Echoes(const std::string& design, const std::string& table) {
    folder_.write("a.scad", design);
    folder_.write("t.csv", table);
    result_ = run(folder_, {"batch", "a.scad", "--table", "t.csv", "-o",
                            "{row}.echo", "-q"});
  }
  std::string of_row(int row) const {
    return read_file(folder_.file(fmt::format("{}.echo", row)));
  }
  std::string errors() const { return result_.errors; }

 private:
  TemporaryFolder folder_;
  support::ProcessResult result_;
};

TEST(Batch, ThePrinterChoosesTheFormat) {
  const TemporaryFolder folder;
  folder.write("a.scad", "h = 1; cube([10, 10, h]);");
  folder.write("t.csv", "name,h\na,1\nb,2\n");
  const auto batch = [&](const std::string& printer) {
    return run(folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{name}",
                        "--layer", "0.5", "--printer", printer});
  };
  EXPECT_EQ(batch("elegoo-mars-4").status, 0);
  for (const char* name : {"a.goo", "b.goo"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
  }
  const auto result = batch("elegoo-mars-3");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "encrypted .ctb files only")) << result.errors;
}

TEST(Batch, ItsReportAddsUp) {
  const TemporaryFolder folder;
  folder.write("a.scad", "h = 1; cube([10, 10, h]);");
  folder.write("t.csv", "name,h\na,1\nb,-1\nc,20\n");
  const auto batch = [&](const std::string& report) {
    return run(folder,
               {"batch", "a.scad", "--table", "t.csv", "-o", "{name}.slc",
                "--layer", "0.5", "--printer", "elegoo-mars-3", "--material",
                "sterling-silver", "--report", report});
  };
  const auto result = batch("r.csv");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "in all: 21.8 g of ")) << result.errors;
  std::istringstream lines(read_file(folder.file("r.csv")));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line.substr(0, line.size() - 1) + ",");
    for (std::string cell; std::getline(cells, cell, ',');) {
      rows.back().push_back(cell);
    }
  }
  ASSERT_EQ(rows.size(), 4U);
  const auto cell = [&](std::size_t row, const std::string& column) {
    const auto at = std::ranges::find(rows[0], column) - rows[0].begin();
    return rows[row].at(static_cast<std::size_t>(at));
  };
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(cell(1, "findings"), "no problems found");
  EXPECT_EQ(cell(1, "layers"), "2");
  EXPECT_EQ(cell(2, "layers"), "");
  EXPECT_NE(cell(2, "error"), "");
  EXPECT_EQ(cell(3, "error"), "");
  batch("r.json");
  const auto json = nlohmann::json::parse(read_file(folder.file("r.json")));
  for (const auto& [column, member] :
       {std::pair("metal_grams", "metal_grams"),
        std::pair("volume_mm3", "volume_mm3"),
        std::pair("print_seconds", "print_seconds")}) {
    EXPECT_NEAR(std::stod(cell(1, column)) + std::stod(cell(3, column)),
                json.at(member).get<double>(), 1e-6)
        << column;
  }
}

// --- Rings ------------------------------------------------------------------

const char* const kBand =
    "use <" LAMINA_EXAMPLES
    "/lib/jewelry.scad>\n"
    "size = 54;\n"
    "width = 3;\n"
    "engraving = \"\";\n"
    "difference() {\n"
    "  cylinder(d = ring_diameter_iso(size) + 4, h = width, $fn = 90);\n"
    "  translate([0, 0, -1])\n"
    "    cylinder(d = ring_diameter_iso(size), h = width + 2, $fn = 90);\n"
    "  translate([9, 0, width - 0.4]) linear_extrude(1)\n"
    "    text(engraving, size = 1.5);\n"
    "}\n";

// 200 rows, of which the 17th, 50th and 120th are bad.
std::string orders() {
  std::string table = "name,size,width,engraving\r\n";
  for (int i = 1; i <= 200; ++i) {
    const std::string size = i == 17   ? "30"
                             : i == 50 ? "fifty"
                                       : fmt::format("{}", 40 + i * 0.15);
    const std::string name = i == 120 ? "../ring" : fmt::format("ring-{}", i);
    table += fmt::format("{},{},{},\"No. {}, {}\"\r\n", name, size,
                         2 + i % 4 * 0.5, i, size);
  }
  return table;
}

std::vector<std::string> batch(const std::string& pattern) {
  return {"batch", "band.scad", "--table", "orders.csv",
          "-o",    pattern,     "--layer", "0.1"};
}

TEST(Batch, OfTwoHundredRingsThreeBadOnesAreToldOfAndTheRestIsMade) {
  const TemporaryFolder folder;
  folder.write("band.scad", kBand);
  folder.write("orders.csv", orders());
  const auto result = run(folder, batch("out/{name}.slc"));
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(count_files(folder.file("out")), 197U);
  EXPECT_EQ(count_lines(result.errors, "orders.csv:"), 3U) << result.errors;
  EXPECT_TRUE(has(result.errors, "orders.csv:18: ring-17: ")) << result.errors;
  EXPECT_TRUE(has(result.errors,
                  "ISO ring size is a circumference of 38 to "
                  "80 mm, got 30"));
  EXPECT_TRUE(has(result.errors,
                  "orders.csv:51: ring-50: error: size: a number was expected, "
                  "not 'fifty' (text would stand in quotes: \"fifty\")\n"));
  EXPECT_TRUE(has(result.errors,
                  "orders.csv:121: ../ring: error: name: '../ring' has a '/' "
                  "in it and can be no part of a file's name\n"));
  EXPECT_TRUE(has(result.errors, "197 of 200 pieces done, 3 failed, in "));
  EXPECT_EQ(count_lines(result.errors, "ring-"), 199U);  // the closing table
}

TEST(Batch, MakesTheBytesOfSingleRuns) {
  const TemporaryFolder folder;
  folder.write("band.scad", kBand);
  folder.write("orders.csv", orders());
  run(folder, batch("{name}.slc"));
  for (const int i : {1, 86, 200}) {
    const std::string size = fmt::format("{}", 40 + i * 0.15);
    run(folder, {"band.scad", "-o", "single.slc", "--layer", "0.1", "-D",
                 "size=" + size, "-D", fmt::format("width={}", 2 + i % 4 * 0.5),
                 "-D", fmt::format("engraving=\"No. {}, {}\"", i, size)});
    EXPECT_EQ(read_file(folder.file(fmt::format("ring-{}.slc", i))),
              read_file(folder.file("single.slc")))
        << i;
  }
}

TEST(Batch, IsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "r = 1; echo(r); assert(r != 4); unknown(); sphere(r);");
  std::string table = "r\n";
  for (int i = 1; i < 20; ++i) table += fmt::format("{}\n", i);
  folder.write("t.csv", table);
  std::string messages[2];
  for (const std::string threads : {"1", "8"}) {
    const auto result = run(
        folder, {"batch", "a.scad", "--table", "t.csv", "-o",
                 threads + "-{row}.slc", "--threads", threads, "--no-strict"});
    EXPECT_EQ(result.status, 1);
    messages[threads == "8"] =
        result.errors.substr(0, result.errors.find("\npieces "));
  }
  EXPECT_EQ(messages[0], messages[1]);
  EXPECT_EQ(count_lines(messages[0], "t.csv:20: ECHO: 19"), 1U) << messages[0];
  for (int i = 1; i < 20; ++i) {
    if (i == 4) continue;
    EXPECT_EQ(read_file(folder.file(fmt::format("1-{}.slc", i))),
              read_file(folder.file(fmt::format("8-{}.slc", i))));
  }
}

// --- Tables -----------------------------------------------------------------

TEST(Batch, CellsHaveTheKindOfTheVariable) {
  const Echoes echoes(
      "size = 1; text = \"\"; open = true; v = [0]; any = undef;\n"
      "echo(size, text, open, v, any);",
      "size,text,open,v,any\n"
      "2.5,2024,FALSE,\"[1, 2]\",x y\n"
      ",,,,\n"
      "3,\"say \"\"yes\"\"\",true,[],\"\"\"10\"\"\"\n");
  EXPECT_EQ(echoes.of_row(1), "ECHO: 2.5, \"2024\", false, [1, 2], \"x y\"\n");
  EXPECT_EQ(echoes.of_row(2), "ECHO: 1, \"\", true, [0], undef\n");
  EXPECT_EQ(echoes.of_row(3), "ECHO: 3, \"say \"yes\"\", true, [], \"10\"\n");
}

TEST(Batch, ReadsWhatAGermanSpreadsheetWrites) {
  const Echoes echoes("size = 1; text = \"\"; echo(size, text, $fn);",
                      "\xef\xbb\xbfsize;text;$fn\r\n"
                      "54,5;\"Anna; J\xc3\xbcrgen\";90\r\n");
  EXPECT_EQ(echoes.of_row(1), "ECHO: 54.5, \"Anna; J\xc3\xbcrgen\", 90\n");
}

TEST(Batch, RefusesAColumnThatIsNoVariable) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; cube(size);");
  folder.write("t.csv", "name,sise,customer\na,2,Ada\n");
  std::vector<std::string> words = {"batch", "a.scad", "--table",
                                    "t.csv", "-o",     "{name}.slc"};
  const auto result = run(folder, words);
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors,
                  "t.csv:1:1: error: 'a.scad' has no variable 'sise' (--skip "
                  "sise ignores the column)\n"))
      << result.errors;
  EXPECT_TRUE(has(result.errors, "has no variable 'customer'"));
  EXPECT_EQ(folder.entry_count(), 2U);
  for (const std::string column : {"sise", "customer"}) {
    words.insert(words.end(), {"--skip", column});
  }
  EXPECT_EQ(run(folder, words).status, 0);
  EXPECT_EQ(folder.entry_count(), 3U);
}

TEST(Batch, RefusesTablesThatItCannotFollow) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; cube(size);");
  const auto message = [&](const std::string& table, const std::string& file) {
    folder.write(file, table);
    const auto result =
        run(folder, {"batch", "a.scad", "--table", file, "-o", "{name}.slc"});
    EXPECT_EQ(result.status, 1);
    return result.errors;
  };
  EXPECT_TRUE(has(message("", "t.csv"), "'t.csv' has no rows"));
  EXPECT_TRUE(has(message("name,size\n", "t.csv"), "'t.csv' has no rows"));
  EXPECT_TRUE(has(message("size\n1\n", "t.csv"),
                  "'name' in '{name}.slc' is no column of 't.csv'"));
  EXPECT_TRUE(has(message("name,size,size\na,1,2\n", "t.csv"),
                  "two columns are called 'size'"));
  EXPECT_TRUE(
      has(message("name,size,\na,1,2\n", "t.csv"), "a column has no name"));
  EXPECT_TRUE(has(message("name,size\na,1\nb,2\na,3\n", "t.csv"),
                  "t.csv:2: a: and t.csv:4: a: would both write 'a.slc'"));
  EXPECT_TRUE(has(message("name\n\"a\n", "t.csv"), "t.csv:2:1: error: this"));
  EXPECT_TRUE(has(message("{}", "t.json"), "has no sets of OpenSCAD"));
  EXPECT_EQ(folder.entry_count(), 3U);  // design and tables
}

TEST(Batch, RefusesRowsThatItCannotFollow) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; cube(size);");
  folder.write("t.csv",
               "name,size\n"
               "a,1,2\n"
               "b\n"
               ",1\n"
               "c..d,1\n"
               "\"e\nf\",1\n"
               "g,1,,\n");
  const auto result = run(
      folder, {"batch", "a.scad", "--table", "t.csv", "-o", "o/{name}.slc"});
  EXPECT_EQ(result.status, 1);
  for (const char* const message :
       {"t.csv:2: a: error: the row has 3 cells, the header has 2\n",
        "t.csv:3: b: error: the row has 1 cells, the header has 2\n",
        "t.csv:4: error: name: '' is empty and can be no part",
        "t.csv:5: c..d: error: name: 'c..d' has '..' in it",
        "error: name: 'e\n  | f' has a line break", "1 of 6 pieces done"}) {
    EXPECT_TRUE(has(result.errors, message)) << message << result.errors;
  }
  EXPECT_EQ(count_files(folder.file("o")), 1U);
}

TEST(Batch, MakesAPieceOfEveryParameterSet) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; echo(size);");
  folder.write("sets.json",
               R"({"fileFormatVersion": "1", "parameterSets":
                   {"wide": {"size": "4"}, "../x": {}, "thin": {"size": "2"}}})");
  const auto result = run(folder, {"batch", "a.scad", "--table", "sets.json",
                                   "-o", "{row}-{name}.echo"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "sets.json: ../x: error: '../x' has a '/'"));
  EXPECT_EQ(read_file(folder.file("1-wide.echo")), "ECHO: 4\n");
  EXPECT_EQ(read_file(folder.file("3-thin.echo")), "ECHO: 2\n");
}

// What a pipe holds can be read once: each piece must know its set from that.
TEST(Batch, ReadsAFileOfParameterSetsOnce) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; echo(size);");
  folder.write("sets.json", R"({"parameterSets":
      {"a": {"size": "4"}, "": {"size": "2"}, "a\u0000b": {}, "x": [1]}})");
  const auto result = support::run_process(
      {"bash", "-c",
       std::string("mkfifo t.json; cat sets.json > t.json & timeout 60 ") +
           LAMINA_PROGRAM + " batch a.scad --table t.json -o {row}.echo"},
      folder.path());
  EXPECT_EQ(result.status, 1) << result.errors;
  EXPECT_TRUE(has(result.errors, "3 of 4 pieces done, 1 failed"))
      << result.errors;
  EXPECT_TRUE(has(result.errors,
                  "t.json: x: error: Cannot apply Parameter Set 'x': 't.json' "
                  "has no such set"))
      << result.errors;
  EXPECT_EQ(read_file(folder.file("1.echo")), "ECHO: 4\n");
  EXPECT_EQ(read_file(folder.file("2.echo")), "ECHO: 2\n");
  EXPECT_EQ(read_file(folder.file("3.echo")), "ECHO: 1\n");
}

TEST(Batch, TellsAllOfANameThatIsNone) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  folder.write("sets.json", R"({"parameterSets": {"a\u0000b": {}}})");
  const auto result = run(
      folder, {"batch", "a.scad", "--table", "sets.json", "-o", "{name}.echo"});
  EXPECT_TRUE(has(result.errors,
                  "'a\\u0000b' has a line break or another control character"))
      << result.errors;
}

// A line that begins with no blank begins with the row that it is of, whatever
// the files of a design are called.
TEST(Batch, AFileOfARowSpeaksForNoOther) {
  const TemporaryFolder folder;
  folder.write("t.csv:3: zoe: error: Out of credit",
               "module m() { assert(false); }\n");
  folder.write("a.scad",
               "s = 1;\n"
               "include <t.csv:3: zoe: error: Out of credit>\n"
               "module n() m();\nn();\n");
  folder.write("t.csv", "name,s\nann,1\n");
  const auto result =
      run(folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{name}.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "zoe")) << result.errors;
  EXPECT_FALSE(has("\n" + result.errors, "\nt.csv:3")) << result.errors;
  EXPECT_FALSE(has("\n" + result.errors, "\nnote")) << result.errors;
  EXPECT_TRUE(has(result.errors, "\n  a.scad:4:1: note: called by 'n'\n"))
      << result.errors;
}

TEST(Batch, ALongNameLengthensNoMessageOfOthers) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; cube(size); if (size > 2) oops();");
  std::string table = "name,size\n" + std::string(100'000, 'A') + ",3\n";
  for (int i = 0; i < 50; ++i) table += fmt::format("n{},1\n", i);
  folder.write("t.csv", table);
  const auto result =
      run(folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.slc"});
  EXPECT_TRUE(has(result.errors, "50 of 51 pieces done")) << result.errors;
  EXPECT_LT(result.errors.size(), 20'000U);
}

TEST(Batch, NoneOfSeveralOutputsIsStandardOutput) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; cube(size);");
  folder.write("-.scad", "cube(1);");
  folder.write("t.csv", "name,size\n-,1\nb,2\n");
  folder.write("s.json", R"({"parameterSets": {"-": {}, "c": {}}})");
  for (const char* table : {"t.csv", "s.json"}) {
    const auto result = run(folder, {"batch", "a.scad", "--table", table, "-o",
                                     "{name}", "--export-format", "svg"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.output, "");
    EXPECT_TRUE(has(result.errors, "-: error: '-' is standard output"))
        << result.errors;
    EXPECT_TRUE(has(result.errors, "1 of 2 pieces done")) << result.errors;
  }
  const auto result = run(
      folder, {"./-.scad", "a.scad", "-o", "{name}", "--export-format", "svg"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.output, "");
}

TEST(Batch, AColumnIsNamedAndNoCode) {
  const TemporaryFolder folder;
  folder.write("a.scad", "size = 1; echo(size, $fn, $a);");
  for (const char* column : {"$a=1;size=9;$b", "$", "$a b", "$fn\n", "$é"}) {
    folder.write("t.csv", fmt::format("\"{}\"\n5\n", column));
    const auto result = run(
        folder, {"batch", "a.scad", "--table", "t.csv", "-o", "{row}.echo"});
    EXPECT_TRUE(has(result.errors, "'a.scad' has no variable"))
        << result.errors;
    EXPECT_FALSE(fs::exists(folder.file("1.echo")));
  }
  EXPECT_EQ(Echoes("echo($fn, $_a1);", "$fn,$_a1\n5,6\n").of_row(1),
            "ECHO: 5, 6\n");
}

TEST(Batch, ColumnsMayFillARow) {
  std::string header = "size";
  for (int i = 0; i < 140'000; ++i) header += fmt::format(",${}", i);
  EXPECT_EQ(Echoes("size = 1; echo(size, $139999);",
                   header + "\n2" + std::string(139'999, ',') + ",3\n")
                .of_row(1),
            "ECHO: 2, 3\n");
}

// Makes a piece and fails at another. Returns the report.
std::string report_of_two(const std::string& report) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "size = 1; assert(size < 5, \"large, too\");"
               "cube(size);");
  folder.write("t.csv", "name,size\na,2\nb,9\n");
  EXPECT_EQ(run(folder, {"batch", "a.scad", "--table", "t.csv", "-o",
                         "{name}.slc", "--report", report})
                .status,
            1);
  return read_file(folder.file(report));
}

TEST(Batch, ReportsEveryPieceAsJson) {
  const auto report = nlohmann::json::parse(report_of_two("r.json"));
  EXPECT_EQ(report["done"], 1);
  EXPECT_EQ(report["failed"], 1);
  const auto& piece = report["pieces"][0];
  EXPECT_EQ(piece["line"], 2);
  EXPECT_EQ(piece["name"], "a");
  EXPECT_EQ(piece["output"], "a.slc");
  EXPECT_TRUE(piece["error"].is_null());
  EXPECT_EQ(piece["report"]["layers"], 40);
  EXPECT_NEAR(piece["report"]["volume_mm3"], 8, 1e-9);
  EXPECT_TRUE(has(report["pieces"][1]["error"], "large, too"));
}

TEST(Batch, ReportsEveryPieceAsATable) {
  std::string text = report_of_two("r.csv");
  SourceStore sources;
  CsvReader reader(
      "r.csv", [&] { return std::exchange(text, ""); }, sources);
  std::vector<CsvRow> rows(3);
  for (CsvRow& row : rows) ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(rows[1].cells.at(3), "40");
  EXPECT_EQ(rows[1].cells.at(6), "2");   // z
  EXPECT_EQ(rows[1].cells.at(7), "8");   // volume
  EXPECT_EQ(rows[1].cells.at(14), "0");  // warnings
  EXPECT_TRUE(has(rows[2].cells.at(16), "large, too"));
  EXPECT_EQ(rows[0].cells.at(17), "supports_mm3");
  EXPECT_EQ(rows[1].cells.size(), rows[0].cells.size());
}

TEST(Batch, AnInterruptLeavesWhatIsDoneAndNothingElse) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "size = 1; cylinder(r1 = 9, r2 = 8, h = size, $fn = 300);");
  folder.write("t.csv", "size\n0.1\n900\n901\n");
  support::BackgroundProcess process(
      command({"batch", "a.scad", "--table", "t.csv", "-o", "{row}.slc",
               "--layer", "0.001", "--threads", "2"}),
      folder.path());
  EXPECT_TRUE(
      support::wait_until([&] { return fs::exists(folder.file("1.slc")); }));
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), 130);
  EXPECT_EQ(folder.entry_count(), 3U);
  EXPECT_TRUE(fs::exists(folder.file("1.slc")));
}

TEST(Batch, MakesTheSignetsOfTheExamples) {
  const TemporaryFolder folder;
  const std::string examples = LAMINA_EXAMPLES;
  const auto result = run(folder, {"batch", examples + "/signet.scad",
                                   "--table", examples + "/signets.csv", "-o",
                                   "{name}.slc", "--layer", "0.2"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(folder.entry_count(), 4U);
}

// --- Several designs --------------------------------------------------------

TEST(SeveralDesigns, AreMadeBesideThemselvesAndOneFaultStopsNoOther) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  folder.write("b.scad", "cube(1;");
  folder.write("c.csg", "sphere(r = 1);");
  folder.write("d.scad", "x = y;");
  const auto result =
      run(folder, {"a.scad", "b.scad", "none.scad", "c.csg", "d.scad"});
  EXPECT_EQ(result.status, 1);
  for (const char* const message :
       {"b.scad:1:7: error: ", "none.scad: error: Can't open input file",
        "\nd.scad:1:5: warning: ", "d.scad: error: Current top level object",
        "\nb.scad     failed\n", "2 of 5 designs done, 3 failed"}) {
    EXPECT_TRUE(has(result.errors, message)) << message << result.errors;
  }
  EXPECT_EQ(folder.entry_count(), 6U);
  run(folder, {"a.scad", "-o", "single.slc"});
  EXPECT_EQ(read_file(folder.file("a.slc")),
            read_file(folder.file("single.slc")));
}

TEST(SeveralDesigns, GoToAFolderOrAPattern) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  folder.write("b.scad", "cube(2);");
  EXPECT_EQ(run(folder, {"a.scad", "b.scad", "-o", "new/out/"}).status, 0);
  EXPECT_TRUE(fs::exists(folder.file("new/out/b.slc")));
  EXPECT_EQ(run(folder, {"a.scad", "b.scad", "-o", "x-{name}.svg"}).status, 0);
  EXPECT_TRUE(fs::exists(folder.file("x-a.svg")));
  EXPECT_EQ(
      run(folder, {"a.scad", "-o", "one/", "--export-format", "cli"}).status,
      0);
  EXPECT_TRUE(fs::exists(folder.file("one/a.cli")));
  EXPECT_EQ(run(folder, {"a.scad", "-o", "{name}-{x}.csg"}).status, 0);
  EXPECT_TRUE(fs::exists(folder.file("a-{x}.csg")));
  // A tree of modules has no size.
  const auto trees = run(folder, {"a.scad", "b.scad", "-o", "{name}.csg"});
  EXPECT_EQ(
      count_lines(trees.errors, "a.scad         0                         - "),
      1U)
      << trees.errors;
  // Nor have layers above it.
  run(folder, {"a.scad", "b.scad", "-o", "{name}.slc", "--heights", "1000",
               "--report", "above.csv"});
  const std::string report = read_file(folder.file("above.csv"));
  EXPECT_TRUE(has(report, ",a.scad,a.slc,1,,,,0,,")) << report;
}

TEST(SeveralDesigns, RefuseWhatIsForOne) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("in"));
  folder.write("a.scad", "cube(1);");
  folder.write("in/a.scad", "cube(2);");
  const std::vector<std::vector<std::string>> mistakes = {
      {"-o", "x.slc"},
      {"-o", "-", "--export-format", "slc"},
      {"-d", "rule"},
  };
  for (const auto& mistake : mistakes) {
    std::vector<std::string> words = {"a.scad", "in/a.scad"};
    words.insert(words.end(), mistake.begin(), mistake.end());
    EXPECT_EQ(run(folder, words).status, 2) << mistake.back();
  }
  // Both would be out/a.slc.
  EXPECT_EQ(run(folder, {"a.scad", "in/a.scad", "-o", "out/"}).status, 1);
  EXPECT_EQ(folder.entry_count(), 2U);
}

}  // namespace
}  // namespace lamina::cli
