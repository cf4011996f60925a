#include "base/csv.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"

namespace lamina {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows read(const std::string& text) {
  const Source source("t.csv", text);
  Rows rows;
  for (const CsvRow& row : read_csv(source).rows) rows.push_back(row.cells);
  return rows;
}

std::vector<std::uint32_t> lines(const std::string& text) {
  const Source source("t.csv", text);
  std::vector<std::uint32_t> lines;
  for (const CsvRow& row : read_csv(source).rows) lines.push_back(row.line);
  return lines;
}

std::string complaint(const std::string& text) {
  const Source source("t.csv", text);
  try {
    read_csv(source);
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
  EXPECT_EQ(csv_words(""), "");
}

}  // namespace
}  // namespace lamina
