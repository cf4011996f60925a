#include "base/file/csv.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"

namespace lamina {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// Gives `text` in blocks of `size` bytes.
CsvReader::Read in_blocks(const std::string& text, std::size_t size) {
  return [text, size, place = std::size_t{0}]() mutable {
    std::string block = text.substr(std::min(place, text.size()), size);
    place += size;
    return block;
  };
}

Rows read(const std::string& text, std::size_t block = 1 << 20) {
  SourceStore sources;
  CsvReader reader("t.csv", in_blocks(text, block), sources);
  Rows rows;
  for (CsvRow row; reader.next(row);) rows.push_back(row.cells);
  return rows;
}

std::vector<std::uint32_t> lines(const std::string& text) {
  SourceStore sources;
  CsvReader reader("t.csv", in_blocks(text, 3), sources);
  std::vector<std::uint32_t> lines;
  for (CsvRow row; reader.next(row);) lines.push_back(row.line);
  return lines;
}

std::string complaint(const std::string& text, std::size_t block = 1 << 20) {
  SourceStore sources;
  CsvReader reader("t.csv", in_blocks(text, block), sources);
  try {
    for (CsvRow row; reader.next(row);) {
    }
  } catch (const FileError& error) {
    return caret_text(error.diagnostic());
  }
  return "";
}

// The forms that RFC 4180 lists in its section 2.
TEST(Csv, ReadsWhatTheRfcDescribes) {
  EXPECT_EQ(read("aaa,bbb\r\nzzz,yyy\r\n"),
            (Rows{{"aaa", "bbb"}, {"zzz", "yyy"}}));
  EXPECT_EQ(read("aaa,bbb\r\nzzz,yyy"), (Rows{{"aaa", "bbb"}, {"zzz", "yyy"}}));
  EXPECT_EQ(read("\"aaa\",\"b\r\nbb\",\"c,c\"\r\nzzz,,xxx"),
            (Rows{{"aaa", "b\r\nbb", "c,c"}, {"zzz", "", "xxx"}}));
  EXPECT_EQ(read("\"aaa\",\"b\"\"bb\",\"\"\n"), (Rows{{"aaa", "b\"bb", ""}}));
}

TEST(Csv, EndsLinesAsAnySystemDoes) {
  EXPECT_EQ(read("a\nb\n"), (Rows{{"a"}, {"b"}}));
  EXPECT_EQ(read("a\rb\r"), (Rows{{"a"}, {"b"}}));
  EXPECT_EQ(read("\n\na\n \t \n\r\nb"), (Rows{{"a"}, {"b"}}));
  EXPECT_EQ(read(""), Rows{});
  EXPECT_EQ(read("a,"), (Rows{{"a", ""}}));
  EXPECT_EQ(read(",\n"), (Rows{{"", ""}}));
}

TEST(Csv, TakesTheSeparatorOfTheFirstLine) {
  EXPECT_EQ(read("a;b\n1,5;2\n"), (Rows{{"a", "b"}, {"1,5", "2"}}));
  EXPECT_EQ(read("a\tb\n\t2\n"), (Rows{{"a", "b"}, {"", "2"}}));
  EXPECT_EQ(read("\"a;b;c\",d\n1;2,3\n"), (Rows{{"a;b;c", "d"}, {"1;2", "3"}}));
  EXPECT_EQ(read("name\n\"Ada, Bea\"\n"), (Rows{{"name"}, {"Ada, Bea"}}));
}

TEST(Csv, PassesOverTheByteOrderMarkAndBlanksAroundCells) {
  EXPECT_EQ(read("\xef\xbb\xbf\"a\";b\n"), (Rows{{"a", "b"}}));
  EXPECT_EQ(read(" a , b c ,\" d \" , \n"), (Rows{{"a", "b c", " d ", ""}}));
}

TEST(Csv, KnowsTheLineOnWhichARowBegins) {
  EXPECT_EQ(lines("a\n\"1\n2\"\n\nb\n"), (std::vector<std::uint32_t>{1, 2, 5}));
}

TEST(Csv, TellsWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint("a,b\n1,\"x\n"),
            "t.csv:2:3: error: this quote has no end\n"
            "    2 | 1,\"x\n"
            "      |   ^\n");
  EXPECT_EQ(complaint("a\n\"1\" ring\n").substr(0, 21),
            "t.csv:2:1: error: the");
  EXPECT_EQ(complaint("a\nJ\xfcrgen\n").substr(0, 39),
            "t.csv:2:2: error: this is no UTF-8 text");
  EXPECT_NE(complaint(std::string("\xff\xfe"
                                  "a\0",
                                  4)),
            "");
  EXPECT_NE(complaint(std::string("a\n\0", 3)), "");
}

TEST(Csv, IsTheSameInBlocksOfAnySize) {
  const std::string table =
      "\xef\xbb\xbfname;\"a; b\"\r\nJ\xc3\xbcrgen; \"x\"\"\r\ny\" \r\n\n\n1;2";
  const std::string fault = "a\nb\n\"x\" y\n";
  for (std::size_t block = 1; block < table.size(); ++block) {
    EXPECT_EQ(read(table, block), read(table)) << block;
    EXPECT_EQ(complaint(fault, block).substr(0, 18), "t.csv:3:1: error: ");
    EXPECT_EQ(complaint("a\nJ\xc3", block).substr(0, 39),
              "t.csv:2:2: error: this is no UTF-8 text");
  }
}

TEST(Csv, KnowsPlacesFarIntoALongTable) {
  std::string table = "a,b\n";
  for (int i = 2; i < 100'000; ++i) table += "x,y\n";
  EXPECT_EQ(complaint(table + "x,\"y\n"),
            "t.csv:100000:3: error: this quote has no end\n"
            "100000 | x,\"y\n"
            "      |   ^\n");
}

TEST(Csv, AQuoteWithoutAnEndTakesNoMoreThanARow) {
  std::string table = "a\n\"b\n";
  for (int i = 0; i < 1'000'000; ++i) table += "row\n";
  EXPECT_EQ(complaint(table).substr(0, 41),
            "t.csv:2:1: error: this row has more than ");
}

TEST(Csv, WrittenCellsAreReadBack) {
  const std::vector<std::string> cells = {"",    "a",           "a,b",
                                          "a;b", "say \"yes\"", " x",
                                          "x ",  "two\nlines",  "J\xc3\xbc"};
  std::string line = "h,h,h,h,h,h,h,h,h\n";
  for (const std::string& cell : cells) line += csv_cell(cell) + ",";
  line.pop_back();
  EXPECT_EQ(read(line).at(1), cells);
}

TEST(Csv, WordsAreNoFormulas) {
  EXPECT_EQ(csv_words("=cmd()"), "'=cmd()");
  EXPECT_EQ(csv_words("+1,2"), "\"'+1,2\"");
  EXPECT_EQ(csv_words("-a"), "'-a");
  EXPECT_EQ(csv_words("@x"), "'@x");
  EXPECT_EQ(csv_words("a=b"), "a=b");
  // Read with ';' or tabs, these would be cells of their own.
  EXPECT_EQ(csv_words("x;=1+1|cmd"), "\"x;'=1+1|cmd\"");
  EXPECT_EQ(csv_words("x\t@a"), "\"x\t'@a\"");
  EXPECT_EQ(csv_words("x\n-a"), "\"x\n'-a\"");
  EXPECT_EQ(csv_words("x;\"=a"), "\"x;\"\"'=a\"");
  EXPECT_EQ(csv_words("x;a=b"), "\"x;a=b\"");
  EXPECT_EQ(csv_words(""), "");
}

}  // namespace
}  // namespace lamina
