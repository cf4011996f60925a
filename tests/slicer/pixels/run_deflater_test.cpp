#include "slicer/pixels/detail/run_deflater.h"

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

namespace lamina::slicer {
namespace {

struct Bytes {
  std::uint8_t value;
  std::size_t count;
};

std::string pack(const std::vector<Bytes>& runs) {
  RunDeflater packed;
  for (const Bytes& run : runs) packed.add(run.value, run.count);
  return packed.finish();
}

std::string bytes_of(const std::vector<Bytes>& runs) {
  std::string bytes;
  for (const Bytes& run : runs) {
    bytes.append(run.count, static_cast<char>(run.value));
  }
  return bytes;
}

// By zlib, which checks the sum too.
std::string unpack(const std::string& packed, std::size_t size) {
  std::string bytes(size + 1, '\0');
  uLongf unpacked = bytes.size();
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &unpacked,
                 reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  EXPECT_EQ(status, Z_OK);
  bytes.resize(unpacked);
  return bytes;
}

void expect_back(const std::vector<Bytes>& runs) {
  const std::string bytes = bytes_of(runs);
  EXPECT_TRUE(unpack(pack(runs), bytes.size()) == bytes);
}

// More runs than a block has; each block has a code of its own.
TEST(RunDeflater, BlocksFollowEachOther) {
  std::mt19937 random(7);
  std::vector<Bytes> runs;
  for (std::size_t i = 0; i < 400000; ++i) {
    const bool is_early = i < 200000;
    runs.push_back({static_cast<std::uint8_t>(i % (is_early ? 2 : 200)),
                    1 + random() % (is_early ? 40 : 4)});
  }
  expect_back(runs);
}

// Rows of black and white with grey edges, as a plate of rings has them.
TEST(RunDeflater, IsSmallerThanZlib) {
  std::mt19937 random(3);
  std::vector<Bytes> runs;
  for (int row = 0; row < 1000; ++row) {
    for (int edge = 0; edge < 12; ++edge) {
      runs.push_back(
          {static_cast<std::uint8_t>(edge % 2 * 255), 20 + random() % 150});
      runs.push_back({static_cast<std::uint8_t>(1 + random() % 254), 1});
    }
  }
  const std::string bytes = bytes_of(runs);
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  ASSERT_EQ(
      compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
      Z_OK);
  EXPECT_LT(pack(runs).size(), size);
}

TEST(RunDeflater, NothingUnpacksToNothing) { expect_back({}); }

TEST(RunDeflater, EveryByteComesBack) {
  std::vector<Bytes> runs;
  for (int value = 0; value < 256; ++value) {
    runs.push_back({static_cast<std::uint8_t>(value), 1});
  }
  expect_back(runs);
}

TEST(RunDeflater, EveryLengthComesBack) {
  for (std::size_t count = 0; count < 5000; ++count) {
    expect_back({{7, 1}, {255, count}, {0, 2}});
  }
}

TEST(RunDeflater, RunsOfOneValueAreOne) {
  EXPECT_EQ(pack({{0, 1000}, {0, 0}, {0, 2000}}), pack({{0, 3000}}));
  EXPECT_EQ(pack({{0, 1000}, {9, 0}, {0, 2000}}), pack({{0, 3000}}));
}

TEST(RunDeflater, RandomRunsComeBack) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<Bytes> runs;
    for (int j = 0; j < 100; ++j) {
      runs.push_back({static_cast<std::uint8_t>(random() % 256),
                      random() % (random() % 2 == 0 ? 5 : 2000)});
    }
    expect_back(runs);
  }
}

// More than the checksum takes at once.
TEST(RunDeflater, LongRunsTakeLittle) {
  const std::vector<Bytes> runs = {{255, 40'000'000}, {0, 40'000'000}};
  expect_back(runs);
  EXPECT_LT(pack(runs).size(), 80'000'000U / 1000);
}

}  // namespace
}  // namespace lamina::slicer
