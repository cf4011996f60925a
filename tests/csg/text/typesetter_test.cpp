// Laws of text. The oracles check that outlines are those of OpenSCAD.

#include "csg/text/typesetter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <ft2build.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include FT_FREETYPE_H

#include "base/utf8.h"
#include "plane/loop_area.h"
#include "plane/region/boolean.h"
#include "plane/region/region.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::text {
namespace {

using Contours = std::vector<std::vector<Vec2>>;

const std::string kLiberation =
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf";

struct Box {
  Vec2 low = Vec2(1e9);
  Vec2 high = Vec2(-1e9);
};

Box box_of(const Contours& contours) {
  Box box;
  for (const auto& contour : contours) {
    for (const Vec2 p : contour) {
      box.low = {std::fmin(box.low.x, p.x), std::fmin(box.low.y, p.y)};
      box.high = {std::fmax(box.high.x, p.x), std::fmax(box.high.y, p.y)};
    }
  }
  return box;
}

csg::TextParams params_of(std::string_view text) {
  csg::TextParams params;
  params.text = text;
  params.font = "Liberation Sans";
  params.direction = "ltr";
  params.language = "en";
  params.script = "Latn";
  params.halign = "left";
  params.valign = "baseline";
  return params;
}

// The difference of two texts that are the same but for a shift; NaN if they
// are not.
Vec2 shift_between(const Contours& from, const Contours& to) {
  if (from.empty() || from.size() != to.size()) return Vec2(std::nan(""));
  const Vec2 shift = to[0][0] - from[0][0];
  for (std::size_t c = 0; c < from.size(); ++c) {
    if (from[c].size() != to[c].size()) return Vec2(std::nan(""));
    for (std::size_t i = 0; i < from[c].size(); ++i) {
      const Vec2 off = to[c][i] - from[c][i] - shift;
      if (std::hypot(off.x, off.y) > 1e-12) return Vec2(std::nan(""));
    }
  }
  return shift;
}

double perimeter(const plane::Region& region) {
  double sum = 0;
  for (const auto& contour : region.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 edge = contour[(i + 1) % contour.size()] - contour[i];
      sum += std::hypot(edge.x, edge.y);
    }
  }
  return sum;
}

class TypesetterTest : public ::testing::Test {
 protected:
  Contours set(const csg::TextParams& params, const Chords& chords = {4}) {
    return typesetter_.outline(params, chords, {}, diagnostics_);
  }
  Contours set(std::string_view text) { return set(params_of(text)); }

  std::vector<std::string> messages() const {
    std::vector<std::string> words;
    for (const Diagnostic& d : diagnostics_.all()) words.push_back(d.message);
    return words;
  }

  Diagnostics diagnostics_;
  std::vector<std::string> warnings_;
  Typesetter typesetter_{{LAMINA_MODULES}, diagnostics_};
};

TEST_F(TypesetterTest, AnOHasAHole) {
  const auto region = plane::from_contours(set("O"), plane::FillRule::kNonZero);
  ASSERT_EQ(region.contours.size(), 2U);
  EXPECT_LT(signed_area(region.contours[0]) * signed_area(region.contours[1]),
            0);
}

TEST_F(TypesetterTest, AnEmptyTextIsEmpty) {
  EXPECT_TRUE(set("").empty());
  EXPECT_TRUE(set("  ").empty());
  EXPECT_TRUE(messages().empty());
}

TEST_F(TypesetterTest, SizeScales) {
  csg::TextParams params = params_of("Ring 57");
  params.size = 1;
  const Contours small = set(params);
  params.size = -8;
  const Contours large = set(params);
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t c = 0; c < small.size(); ++c) {
    ASSERT_EQ(small[c].size(), large[c].size());
    for (std::size_t i = 0; i < small[c].size(); ++i) {
      EXPECT_EQ(large[c][i], -8.0 * small[c][i]);
    }
  }
}

TEST_F(TypesetterTest, EverySegmentOfACurveIsAVertex) {
  const auto count = [&](int segments) {
    std::size_t points = 0;
    for (const auto& contour : set(params_of("S"), {segments})) {
      points += contour.size();
    }
    return points;
  };
  const std::size_t curves = count(2) - count(1);
  EXPECT_GT(curves, 10U);
  EXPECT_EQ(count(17), count(1) + 16 * curves);
}

TEST_F(TypesetterTest, CurvesGrowTowardsTheirLimit) {
  const auto area = [&](int segments) {
    return plane::area(plane::from_contours(set(params_of("o"), {segments}),
                                            plane::FillRule::kNonZero));
  };
  // The error of a chord falls with the square of their number.
  const double error8 = area(64) - area(8);
  const double error16 = area(64) - area(16);
  EXPECT_NEAR(error8 / error16, 4, 0.3);
}

TEST_F(TypesetterTest, AChordalErrorIsKeptWithFewVertices) {
  const auto region = [&](const Chords& chords) {
    return plane::from_contours(set(params_of("Ogs"), chords),
                                plane::FillRule::kNonZero);
  };
  const plane::Region exact = region({100});
  std::size_t fewer = 100000;
  for (const double error : {0.001, 0.01, 0.1}) {
    const plane::Region rough = region({4, error});
    const plane::Region both[] = {exact, rough};
    const plane::Region all = plane::unite(both);
    const plane::Region common = plane::intersect(both);
    // Chords of height h leave segments of ⅔ of their length times h.
    const double difference = plane::area(all) - plane::area(common);
    EXPECT_LE(difference, 2.0 / 3 * error * perimeter(exact));
    EXPECT_GE(difference, 0.02 * error * perimeter(exact));
    std::size_t count = 0;
    for (const auto& contour : rough.contours) count += contour.size();
    EXPECT_LT(count, fewer);
    fewer = count;
  }
}

TEST_F(TypesetterTest, AlignmentOnlyShifts) {
  csg::TextParams params = params_of("Apogee");
  const Contours left = set(params);
  params.halign = "center";
  const Vec2 to_center = shift_between(left, set(params));
  params.halign = "right";
  const Vec2 to_right = shift_between(left, set(params));
  EXPECT_LT(to_center.x, 0);
  EXPECT_NEAR(to_right.x, 2 * to_center.x, 1e-12);
  EXPECT_EQ(to_right.y, 0);

  params.halign = "left";
  const Box box = box_of(left);
  params.valign = "top";
  const Vec2 to_top = shift_between(left, set(params));
  params.valign = "bottom";
  const Vec2 to_bottom = shift_between(left, set(params));
  params.valign = "center";
  const Vec2 to_middle = shift_between(left, set(params));
  EXPECT_EQ(to_top.x, 0);
  // 2.4% less than the outline is high: OpenSCAD's scales differ.
  EXPECT_NEAR(to_top.y, -box.high.y / 1.024, 0.01);
  EXPECT_NEAR(to_bottom.y, -box.low.y / 1.024, 0.01);
  EXPECT_NEAR(to_middle.y, (to_top.y + to_bottom.y) / 2, 1e-12);
}

TEST_F(TypesetterTest, TheWidthOfARowIsTheSumOfItsGlyphs) {
  const auto width = [&](std::string_view text, double spacing) {
    csg::TextParams params = params_of(text);
    params.spacing = spacing;
    const Contours left = set(params);
    params.halign = "right";
    return -shift_between(left, set(params)).x;
  };
  EXPECT_NEAR(width("nmn", 1), 2 * width("n", 1) + width("m", 1), 1e-9);
  EXPECT_NEAR(width("nmn", 2.5), 2.5 * width("nmn", 1), 1e-9);
  // Kerning draws these together.
  EXPECT_LT(width("AV", 1), width("A", 1) + width("V", 1) - 0.1);
}

TEST_F(TypesetterTest, ARightToLeftTextIsMirroredInOrder) {
  csg::TextParams params = params_of("no");
  params.direction = "rtl";
  EXPECT_EQ(set(params), set("on"));
}

TEST_F(TypesetterTest, AColumnRunsDown) {
  csg::TextParams params = params_of("III");
  params.direction = "ttb";
  const Box column = box_of(set(params));
  const Box one = box_of(set("I"));
  EXPECT_NEAR(column.high.x - column.low.x, one.high.x - one.low.x, 1e-9);
  EXPECT_LT(column.low.y, 2 * (one.low.y - one.high.y));
}

TEST_F(TypesetterTest, CombiningMarksJoinTheirLetter) {
  const auto area = [&](std::string_view text) {
    return plane::area(
        plane::from_contours(set(text), plane::FillRule::kNonZero));
  };
  EXPECT_GT(area("A\u030a"), area("A"));
  EXPECT_NEAR(area("n\u00f1"), area("nn\u0303"), 0.5);
}

TEST_F(TypesetterTest, UnknownAlignmentsAreReportedInOpenScadsWords) {
  csg::TextParams params = params_of("A");
  params.halign = "middle";
  params.valign = "";
  EXPECT_EQ(set(params), set("A"));
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "Unknown value for the halign parameter (use \"left\", "
                "\"right\" or \"center\"): 'middle'",
                "Unknown value for the valign parameter (use \"baseline\", "
                "\"bottom\", \"top\" or \"center\"): ''"}));
}

TEST_F(TypesetterTest, BytesThatAreNoUtf8DoNoHarm) {
  EXPECT_FALSE(set("A\xff\xc3").empty());
}

// --- Letters that a font lacks ----------------------------------------------

// As FreeType reads the file's own table of characters.
class CharacterTable {
 public:
  explicit CharacterTable(const std::string& file) {
    FT_Init_FreeType(&library_);
    FT_New_Face(library_, file.c_str(), 0, &face_);
  }
  ~CharacterTable() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  CharacterTable(const CharacterTable&) = delete;
  CharacterTable& operator=(const CharacterTable&) = delete;

  bool has(unsigned letter) const {
    return FT_Get_Char_Index(face_, letter) != 0;
  }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

// Letters of many scripts, none of which others make up.
std::vector<unsigned> some_letters() {
  std::vector<unsigned> letters;
  std::mt19937 random(1);
  for (const auto& [first, last] : {std::pair(0x41U, 0x5AU),
                                    {0x391U, 0x3A1U},
                                    {0x410U, 0x42FU},
                                    {0x5D0U, 0x5EAU},
                                    {0x627U, 0x64AU},
                                    {0x10D0U, 0x10F0U},
                                    {0x16A0U, 0x16EAU},
                                    {0x2654U, 0x265FU},
                                    {0x4E00U, 0x9FA0U},
                                    {0x1F400U, 0x1F4FFU}}) {
    for (int i = 0; i < 15; ++i) {
      letters.push_back(std::uniform_int_distribution(first, last)(random));
    }
  }
  return letters;
}

TEST_F(TypesetterTest, LettersThatAFontLacksAreNamedWithAFontThatHasThem) {
  const CharacterTable table(kLiberation);
  int lacking = 0;
  int told = 0;
  for (const unsigned letter : some_letters()) {
    std::string text = "a";
    ASSERT_TRUE(append_utf8(letter, text));
    Diagnostics diagnostics;
    const auto said = [&](const std::string& font) {
      csg::TextParams params = params_of(text);
      params.font = font;
      const std::size_t before = diagnostics.all().size();
      typesetter_.outline(params, {4}, {}, diagnostics);
      return diagnostics.all().size() == before
                 ? std::string()
                 : diagnostics.all().back().message;
    };
    const std::string words = said("Liberation Sans");
    EXPECT_EQ(words.empty(), table.has(letter)) << words;
    if (words.empty()) continue;
    ++lacking;
    EXPECT_TRUE(words.starts_with(
        fmt::format("Font 'Liberation Sans' cannot draw '{}' (U+{:04X}), and "
                    "leaves a box or a gap; ",
                    text.substr(1), letter)))
        << words;
    const std::size_t begin = words.find('"');
    if (begin == std::string::npos) continue;
    ++told;
    const std::string font =
        words.substr(begin + 1, words.find('"', begin + 1) - begin - 1);
    if (words.ends_with(" can, but not the rest")) text.erase(0, 1);
    EXPECT_EQ(said(font), "") << words;
  }
  EXPECT_GT(lacking, 50);
  EXPECT_GT(told, 20);
}

TEST_F(TypesetterTest, LettersThatAFontLacksAreListed) {
  set("\u611b\u60c5 \u611b\n");
  ASSERT_EQ(messages().size(), 1U);
  EXPECT_TRUE(messages()[0].starts_with(
      "Font 'Liberation Sans' cannot draw '\u611b' (U+611B), '\u60c5' "
      "(U+60C5), U+000A, and leaves"))
      << messages()[0];
  EXPECT_EQ(diagnostics_.all()[0].severity, Severity::kWarning);
  EXPECT_EQ(diagnostics_.all()[0].audience, Audience::kTerminal);
}

// A joiner, a variation selector and marks draw nothing of their own.
TEST_F(TypesetterTest, WhatShapesOtherLettersIsNotMissing) {
  set("a\u200db\ufe0fc\u0301 e\u0301\u00ad");
  EXPECT_EQ(messages(), std::vector<std::string>());
}

// --- Metrics ----------------------------------------------------------------

TEST_F(TypesetterTest, TheBoxOfALetterIsThatOfItsOutline) {
  // Boxes are rounded outwards to whole pixels of size/1562.5 mm.
  const double pixel = 10 / 1562.5;
  for (const char* letter : {"O", "g", "W"}) {
    csg::TextParams params = params_of(letter);
    const auto metrics = typesetter_.measure_text(params, warnings_);
    const Box box = box_of(set(params, {100}));
    EXPECT_NEAR(metrics->position.x, box.low.x, pixel) << letter;
    EXPECT_NEAR(metrics->position.y, box.low.y, pixel);
    EXPECT_NEAR(metrics->position.x + metrics->size.x, box.high.x, pixel);
    EXPECT_NEAR(metrics->position.y + metrics->size.y, box.high.y, pixel);
    EXPECT_NEAR(metrics->ascent, box.high.y, pixel);
    EXPECT_NEAR(metrics->descent, box.low.y, pixel);
  }
}

TEST_F(TypesetterTest, TheBoxIsThatOfWhatIsDrawn) {
  const double pixel = 10 / 1562.5;
  for (const char* direction : {"ltr", "rtl", "ttb"}) {
    for (const char* halign : {"left", "center", "right"}) {
      for (const char* valign : {"top", "center", "baseline", "bottom"}) {
        SCOPED_TRACE(std::string(direction) + " " + halign + " " + valign);
        csg::TextParams params = params_of("Apogee fly");
        params.direction = direction;
        params.halign = halign;
        params.valign = valign;
        params.spacing = 1.3;
        const auto metrics = typesetter_.measure_text(params, warnings_);
        const Box box = box_of(set(params, {100}));
        EXPECT_NEAR(metrics->position.x, box.low.x, pixel);
        EXPECT_NEAR(metrics->position.y, box.low.y, pixel);
        EXPECT_NEAR(metrics->position.x + metrics->size.x, box.high.x, pixel);
        EXPECT_NEAR(metrics->position.y + metrics->size.y, box.high.y, pixel);
      }
    }
  }
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(TypesetterTest, AlignmentMovesTheBoxByTheOffset) {
  csg::TextParams params = params_of("Apogee");
  const auto left = typesetter_.measure_text(params, warnings_);
  EXPECT_EQ(left->offset, Vec2(0));
  params.halign = "right";
  const auto right = typesetter_.measure_text(params, warnings_);
  EXPECT_EQ(right->offset, Vec2(-left->advance.x, 0));
  EXPECT_NEAR(right->position.x, left->position.x + right->offset.x, 1e-12);
}

TEST_F(TypesetterTest, ABlankHasAnAdvanceOnly) {
  const auto metrics = typesetter_.measure_text(params_of("  "), warnings_);
  EXPECT_EQ(metrics->size, Vec2(0));
  EXPECT_EQ(metrics->ascent, 0);
  // Two blanks of 569 units, 2048 to the em of 100/72 sizes.
  EXPECT_NEAR(metrics->advance.x, 2 * 569 / 2048.0 * 1000 / 72 / 1.024, 1e-3);
}

TEST_F(TypesetterTest, AFontTellsItsMeasures) {
  const auto metrics = typesetter_.measure_font(params_of(""), warnings_);
  const double unit = 1000.0 / 72 / 2048;
  EXPECT_NEAR(metrics->nominal_ascent, 1854 * unit, 1e-3);
  EXPECT_NEAR(metrics->nominal_descent, -434 * unit, 1e-3);
  EXPECT_NEAR(metrics->interline, (1854 + 434 + 67) * unit, 1e-3);
  EXPECT_GT(metrics->max_ascent, metrics->nominal_ascent);
  EXPECT_EQ(metrics->family, "Liberation Sans");
  EXPECT_EQ(metrics->style, "Regular");
}

// --- Fonts ------------------------------------------------------------------

TEST_F(TypesetterTest, StylesAreFound) {
  csg::TextParams params = params_of("l");
  const Box regular = box_of(set(params));
  params.font = " Liberation Sans:style=Bold ";
  const Box bold = box_of(set(params));
  EXPECT_GT(bold.high.x - bold.low.x, 1.3 * (regular.high.x - regular.low.x));
  params.font = "Liberation Sans:bold";
  EXPECT_EQ(box_of(set(params)).high, bold.high);
  EXPECT_TRUE(messages().empty());
}

TEST_F(TypesetterTest, TheDefaultFontIsLiberationSans) {
  csg::TextParams params = params_of("Ag");
  params.font = "";
  EXPECT_EQ(set(params), set("Ag"));
}

TEST_F(TypesetterTest, AMissingFontIsReplacedWithAWarning) {
  csg::TextParams params = params_of("A");
  params.font = "No Such Font:style=Bold";
  EXPECT_FALSE(set(params).empty());
  ASSERT_EQ(messages().size(), 1U);
  EXPECT_EQ(messages()[0].rfind("Font 'No Such Font' not found, '", 0), 0U);
}

TEST_F(TypesetterTest, MetricTwinsAndKindsOfFontsAreNotMissing) {
  csg::TextParams params = params_of("A");
  for (const char* font : {"Arial", "Times New Roman:bold", "monospace",
                           "serif", ":style=Bold", "LIBERATION sans"}) {
    params.font = font;
    EXPECT_FALSE(set(params).empty());
    EXPECT_TRUE(messages().empty()) << font << ": " << messages()[0];
  }
}

// Bytes that the process has of the heap.
std::size_t bytes_kept() {
  const struct mallinfo2 heap = ::mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

TEST_F(TypesetterTest, ManyNamesOfOneFontKeepItOnce) {
  csg::TextParams params = params_of("A");
  params.font = "No Such Font";
  const Contours outline = set(params);
  const std::size_t before = bytes_kept();
  constexpr int kNames = 200;
  for (int i = 0; i < kNames; ++i) {
    const std::string name = "No Such Font " + std::to_string(i);
    params.font = name;
    EXPECT_EQ(set(params), outline) << name;
  }
  EXPECT_EQ(messages().size(), kNames + 1U);
  EXPECT_LT(bytes_kept(), before + std::size_t{kNames} * 8192);
  EXPECT_EQ(typesetter_.files_read().size(), 1U);
}

// A font of another name than any that is installed: Liberation Sans, misspelt.
std::string renamed_font() {
  std::string bytes = support::read_file(kLiberation);
  const auto replace = [&](const std::string& from, char by, std::size_t at) {
    for (std::size_t i = bytes.find(from); i != std::string::npos;
         i = bytes.find(from, i + 1)) {
      bytes[i + at] = by;
    }
  };
  replace("Liberation", 'Z', 0);
  replace({"\0L\0i\0b\0e\0r\0a\0t\0i\0o\0n", 20}, 'Z', 1);
  return bytes;
}

TEST_F(TypesetterTest, AFontThatTheDesignBringsIsUsed) {
  const support::TemporaryFolder folder;
  typesetter_.add_fonts({folder.write("own.ttf", renamed_font())});
  csg::TextParams params = params_of("Ag");
  params.font = "Ziberation Sans";
  EXPECT_EQ(set(params), set("Ag"));
  EXPECT_TRUE(messages().empty());
}

TEST_F(TypesetterTest, FoldersOfTheEnvironmentAreSearched) {
  const support::TemporaryFolder folder;
  folder.write("own.ttf", renamed_font());
  setenv("OPENSCAD_FONT_PATH", ("/nowhere:" + folder.path()).c_str(), 1);
  csg::TextParams params = params_of("Ag");
  params.font = "Ziberation Sans";
  EXPECT_EQ(set(params), set("Ag"));
  EXPECT_TRUE(messages().empty());
  unsetenv("OPENSCAD_FONT_PATH");
}

TEST_F(TypesetterTest, ABrokenFontFileIsReportedAndLeftOut) {
  const support::TemporaryFolder folder;
  const std::string whole = support::read_file(kLiberation);
  const std::string cut = folder.write("cut.ttf", whole.substr(0, 5000));
  const std::string empty = folder.write("empty.ttf", "");
  const std::string noise = folder.write("noise.otf", std::string(999, 'x'));
  typesetter_.add_fonts({cut, empty, noise});
  EXPECT_FALSE(set("A").empty());
  EXPECT_EQ(messages(),
            (std::vector<std::string>{"Can't register font '" + cut + "'",
                                      "Can't register font '" + empty + "'",
                                      "Can't register font '" + noise + "'"}));
}

TEST_F(TypesetterTest, ACutFontIsReplacedByAnother) {
  const support::TemporaryFolder folder;
  const std::string whole = renamed_font();
  for (std::size_t size = 20000; size < whole.size(); size += 30000) {
    Diagnostics diagnostics;
    Typesetter typesetter({LAMINA_MODULES}, diagnostics);
    typesetter.add_fonts({folder.write("cut.ttf", whole.substr(0, size))});
    csg::TextParams params = params_of("The quick brown fox");
    params.font = "Ziberation Sans";
    EXPECT_FALSE(typesetter.outline(params, {4}, {}, diagnostics).empty());
    ASSERT_EQ(diagnostics.all().size(), 1U) << size;
    EXPECT_TRUE(diagnostics.all()[0].message.starts_with(
        "Font 'Ziberation Sans' not found, "))
        << diagnostics.all()[0].message;
  }
}

TEST_F(TypesetterTest, GlyphsThatAreNoiseAreLeftOutAndNamed) {
  const support::TemporaryFolder folder;
  const std::string whole = renamed_font();
  const std::size_t whole_count = set("The quick brown fox").size();
  std::size_t left_out = 0;
  for (std::size_t at = 20000; at < whole.size(); at += 10000) {
    std::string noisy = whole;
    for (std::size_t i = at; i < std::min(at + 3000, noisy.size()); ++i) {
      noisy[i] = static_cast<char>(i * i >> 3);
    }
    Diagnostics diagnostics;
    Typesetter typesetter({LAMINA_MODULES}, diagnostics);
    typesetter.add_fonts({folder.write("noisy.ttf", noisy)});
    csg::TextParams params = params_of("The quick brown fox");
    params.font = "Ziberation Sans";
    const Contours contours = typesetter.outline(params, {4}, {}, diagnostics);
    EXPECT_EQ(contours.size() < whole_count, !diagnostics.all().empty()) << at;
    for (const Diagnostic& message : diagnostics.all()) {
      EXPECT_TRUE(message.message.starts_with("Could not load glyph ") ||
                  message.message.starts_with("Font 'Ziberation Sans' cannot"))
          << message.message;
    }
    left_out += diagnostics.all().size();
  }
  EXPECT_GT(left_out, 0U);
}

// Pages of a mapped file that are gone would end the process.
TEST_F(TypesetterTest, AFontThatIsEmptiedMeanwhileStaysWhole) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("own.ttf", renamed_font());
  typesetter_.add_fonts({file});
  csg::TextParams params = params_of("A");
  params.font = "Ziberation Sans";
  EXPECT_EQ(set(params), set("A"));
  folder.write("own.ttf", "");
  params = params_of("The quick brown fox");
  params.font = "Ziberation Sans";
  EXPECT_EQ(set(params), set("The quick brown fox"));
}

TEST_F(TypesetterTest, AFontThatTheMachineCannotReadIsAnError) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("own.ttf", renamed_font());
  const FileAccess access = FileAccess::within({folder.path(), {}, false});
  const auto whole = set("A");  // opens the module, too
  for (const FileAccess* const files : {&access, &kAllFiles}) {
    Typesetter typesetter({LAMINA_MODULES}, diagnostics_, *files);
    typesetter.add_fonts({file});
    csg::TextParams params = params_of("A");
    params.font = "Ziberation Sans";
    rlimit before{};
    ::getrlimit(RLIMIT_NOFILE, &before);
    const rlimit none{1, before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
    EXPECT_THROW(typesetter.outline(params, {4}, {}, diagnostics_), FileError);
    ::setrlimit(RLIMIT_NOFILE, &before);
    Typesetter again({LAMINA_MODULES}, diagnostics_, *files);
    again.add_fonts({file});
    EXPECT_EQ(again.outline(params, {4}, {}, diagnostics_), whole);
  }
}

TEST(Typesetter, SaysWhereAMissingModuleWasLookedFor) {
  Diagnostics diagnostics;
  Typesetter typesetter({"/nowhere", "/neither"}, diagnostics);
  try {
    typesetter.outline(params_of("A"), {4}, {}, diagnostics);
    FAIL() << "no error";
  } catch (const GeometryError& error) {
    EXPECT_STREQ(error.what(),
                 "Can't find the module for text(), lamina_text.so, in "
                 "/nowhere or /neither");
  }
}

TEST(Typesetter, SaysThatAModuleCannotBeOpened) {
  const support::TemporaryFolder folder;
  folder.write("lamina_text.so", "no library");
  Diagnostics diagnostics;
  Typesetter typesetter({folder.path()}, diagnostics);
  EXPECT_THROW(typesetter.outline(params_of("A"), {4}, {}, diagnostics),
               GeometryError);
}

}  // namespace
}  // namespace lamina::text
