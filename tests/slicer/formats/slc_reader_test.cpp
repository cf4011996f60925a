#include "slicer/formats/slc_reader.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "tests/support/temporary_folder.h"

namespace lamina::slicer {
namespace {

using namespace std::string_literals;
using support::TemporaryFolder;

const std::string kHead =
    "-SLCVER 2.0 -UNIT MM -TYPE PART -PACKAGE other 1.0 "
    "-EXTENTS -1.5,2 0,3e1 0.0,1\r\n\x1A" +
    std::string(256, 'x');
const std::string kTable =
    "\x01"
    "\x00\x00\x00\x00"
    "\x00\x00\x00\x3F"
    "\x00\x00\x00\x00"
    "\x00\x00\x00\x00"s;
// A layer at z = 0.5 with one open boundary of two vertices.
const std::string kLayer =
    "\x00\x00\x00\x3F\x01\x00\x00\x00"
    "\x02\x00\x00\x00\x01\x00\x00\x00"
    "\x00\x00\x80\x3F\x00\x00\x00\x40\x00\x00\x00\x40\x00\x00\x80\x3F"s;
const std::string kEnd = "\x00\x00\x80\x3F\xFF\xFF\xFF\xFF"s;

struct Closing {
  int file;
  ~Closing() { ::close(file); }
};

// Reads everything; returns the words of the error, or nothing. The file lies
// in memory: there are thousands.
//
// look  called with each layer before the error
template <typename Look>
std::string read_all(const std::string& bytes, const Look& look) {
  const int file = ::memfd_create("slc", 0);
  EXPECT_EQ(::write(file, bytes.data(), bytes.size()),
            static_cast<ssize_t>(bytes.size()));
  const Closing closing{file};
  try {
    SlcReader reader("/proc/self/fd/" + std::to_string(file));
    SlcLayer layer;
    while (reader.read_layer(layer)) look(layer);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

std::string error_of(const std::string& bytes) {
  return read_all(bytes, [](const SlcLayer& layer) { to_layer(layer); });
}

TEST(SlcReader, ReadsWhatIsThere) {
  const TemporaryFolder folder;
  SlcReader reader(folder.write("a.slc", kHead + kTable + kLayer + kEnd));
  EXPECT_EQ(reader.facts().format, "SLC 2.0");
  EXPECT_EQ(reader.facts().header, "PART, unit MM");
  EXPECT_EQ(reader.facts().writer, "other 1.0");
  ASSERT_TRUE(reader.facts().extents.has_value());
  EXPECT_EQ((*reader.facts().extents)[1], Vec2(0, 30));
  ASSERT_EQ(reader.facts().sampling.size(), 1U);
  EXPECT_EQ(reader.facts().sampling[0].thickness, 0.5F);

  SlcLayer layer;
  ASSERT_TRUE(reader.read_layer(layer));
  EXPECT_EQ(layer.z, 0.5);
  EXPECT_EQ(layer.thickness, 0.5);
  ASSERT_EQ(layer.boundaries.size(), 1U);
  EXPECT_EQ(layer.boundaries[0].gaps, 1U);
  EXPECT_EQ(layer.boundaries[0].points, (std::vector<Vec2>{{1, 2}, {2, 1}}));
  EXPECT_FALSE(reader.read_layer(layer));
  EXPECT_EQ(reader.facts().top, 1.0);
}

// The blank is that of one word or of the other.
TEST(SlcReader, TakesNoBoundWithoutANumber) {
  std::string head = kHead;
  head.replace(head.find("other 1.0"), 9, "other within mm");
  const TemporaryFolder folder;
  const SlcReader reader(folder.write("a.slc", head + kTable + kEnd));
  EXPECT_FALSE(reader.facts().deviation.has_value());
  EXPECT_EQ(reader.facts().writer, "other within mm");
}

TEST(SlcReader, InchesBecomeMillimetres) {
  std::string head = kHead;
  head.replace(head.find("MM"), 2, "INCH");
  const TemporaryFolder folder;
  SlcReader reader(folder.write("a.slc", head + kTable + kLayer + kEnd));
  SlcLayer layer;
  ASSERT_TRUE(reader.read_layer(layer));
  EXPECT_DOUBLE_EQ(layer.z, 12.7);
  EXPECT_EQ(layer.boundaries.at(0).points.at(0), Vec2(25.4, 50.8));
}

TEST(SlcReader, NamesTheOtherFormatsThatBearTheSuffix) {
  EXPECT_NE(error_of("Slice V0.2\nsomething").find("Stratasys"),
            std::string::npos);
  EXPECT_NE(error_of("64 64 64 0 \x58").find("VTK"), std::string::npos);
  EXPECT_NE(error_of("solid ring").find("-SLCVER"), std::string::npos);
  EXPECT_NE(error_of("").find("-SLCVER"), std::string::npos);
}

TEST(SlcReader, SaysWhereAFileIsCutOff) {
  const std::string whole = kHead + kTable + kLayer + kEnd;
  EXPECT_EQ(error_of(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(error_of(whole.substr(0, size)), "") << size << " bytes";
  }
  EXPECT_NE(error_of(kHead + kTable + kLayer).find("the file ends at byte"),
            std::string::npos);
}

TEST(SlcReader, AHugeCountEndsAtTheEndOfTheFile) {
  const std::string huge = "\xFE\xFF\xFF\xFF"s;
  EXPECT_NE(error_of(kHead + kTable + "\x00\x00\x00\x00"s + huge + kEnd), "");
  EXPECT_NE(error_of(kHead + kTable + "\x00\x00\x00\x00\x01\x00\x00\x00"s +
                     huge + "\x00\x00\x00\x00"s + kEnd),
            "");
}

TEST(SlcReader, RefusesHeadersWithoutEndAndTablesWithoutRows) {
  EXPECT_NE(error_of("-SLCVER 2.0 -UNIT MM " + std::string(5000, ' ')), "");
  EXPECT_NE(error_of(kHead + "\x00"s + kEnd), "");
}

TEST(SlcReader, RefusesCoordinatesThatAreNoNumbers) {
  std::string layer = kLayer;
  layer.replace(16, 4, "\x00\x00\xC0\x7F"s);
  EXPECT_NE(error_of(kHead + kTable + layer + kEnd), "");
}

// All numbers are finite, no layer has more vertices than the file has bytes
// for, and none gets lost on the way to the layer's contours.
TEST(SlcReader, ChangedBytesAreErrorsOrGiveSoundLayers) {
  const std::string whole = kHead + kTable + kLayer + kLayer + kEnd;
  std::mt19937 random(1);
  int refused = 0;
  int read_all_the_same = 0;
  for (int run = 0; run < 2000; ++run) {
    std::string bytes = whole;
    const auto changes = 1 + random() % 4;
    for (unsigned i = 0; i < changes; ++i) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    const std::string error = read_all(bytes, [&](const SlcLayer& layer) {
      std::size_t vertices = 0;
      for (const WrittenLoop& loop : layer.boundaries) {
        const std::size_t size = loop.points.size();
        vertices +=
            size - (size > 1 && loop.points.front() == loop.points.back());
        for (const Vec2& point : loop.points) {
          EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
        }
      }
      EXPECT_LE(8 * vertices, bytes.size());
      EXPECT_TRUE(std::isfinite(layer.z) && std::isfinite(layer.thickness));
      const Layer read = to_layer(layer);
      EXPECT_EQ(read.contours.loop_count(), layer.boundaries.size());
      EXPECT_EQ(read.contours.points.size(), vertices);
    });
    ++(error.empty() ? read_all_the_same : refused);
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(read_all_the_same, 100);
}

TEST(SlcReader, NothingButPaddingStandsBehindTheEnd) {
  const std::string whole = kHead + kTable + kLayer + kEnd;
  EXPECT_EQ(error_of(whole + "\0\0 \r\n\x1A"s), "");
  for (const std::string& rest : {whole, "\0x"s}) {
    const std::size_t byte = whole.size() + (rest == whole ? 0 : 1);
    EXPECT_TRUE(error_of(whole + rest)
                    .ends_with("something stands behind the end record, at "
                               "byte " +
                               std::to_string(byte)))
        << error_of(whole + rest);
  }
}

TEST(SlcReader, AMissingFileIsAnError) {
  EXPECT_THROW(SlcReader("/no/such/file.slc"), FileError);
}

}  // namespace
}  // namespace lamina::slicer
